// The camera of the example.
#pragma once

#include "forward_pass.h"

/// One that looks at the origin, for a panel of this size. The placement of FrameConstants is left out.
FrameConstants camera(VkExtent2D size);
