// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace kappa::view_detail {

struct Session;

/// Does what the key does that X calls `keysym`. Returns false if the key has no meaning.
/// @throws Error as the action does.
bool press_key(Session& session, const std::string& keysym);

/// The most important keys, a few words each, the most useful first.
std::vector<std::string> key_line();

/// What the mouse and all keys do, a line each.
std::string help_text();

}  // namespace kappa::view_detail
