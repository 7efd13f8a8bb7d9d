// The name of the data behind a Context, for rooms that only pass it on.
#pragma once

#include "base/internals.h"
#include "medial_vk/context.h"

namespace medial_vk {

using ContextImpl = Internals::ImplOf<Context>::Type;

}  // namespace medial_vk
