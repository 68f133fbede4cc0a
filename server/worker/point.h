#pragma once
/// @file
/// The former place of server/sweeps/point.h.

#include "server/sweeps/point.h"
