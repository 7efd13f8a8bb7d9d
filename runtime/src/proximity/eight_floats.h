#pragma once

#include "base/eight_floats.h"
