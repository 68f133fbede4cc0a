#pragma once
/// @file
/// Readers of the laws of foundations, springs and joints. Internal to api/.

#include "api/value.h"
#include "solver/model/model.h"

namespace snapthrough::api {

/// Reads a number, or {"along": [[fraction, value], ...]}.
void read(const Value& value, AlongMember& out);
inline void set_unread(AlongMember& out) { set_unread(out.constant); }

/// Reads a law by its `type`.
void read(const Value& value, ReactionLaw& out);
void read(const Value& value, BendingLaw& out);

/// Reads the stiffness "rigid" as infinity; false where the value is no text.
bool read_rigid(const Value& value, double& out);
/// Reads `stiffness` or `law` of a spring or foundation, of which exactly one must be there.
void read_law(Object& in, Spring& out);
void read_law(Object& in, Foundation& out);

}  // namespace snapthrough::api
