#pragma once
/// @file
/// The former place of server/sweeps/unit.h.

#include "server/sweeps/unit.h"
