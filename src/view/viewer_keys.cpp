// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_keys.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "viewer_session.hpp"

namespace kappa {
namespace view_detail {
namespace {

constexpr double kRangeStep = 1.25;
constexpr double kMostRange = 1e6;  // times the automatic range; keeps the ends of the range distinct numbers

void step_field(Session& s, int step) {
  if (!s.has_data()) return;
  const int count = static_cast<int>(s.data.fields.size());
  // The first press in front of labels leads back to the field behind them.
  if (!s.labels) s.field = static_cast<std::size_t>((static_cast<int>(s.field) + count + step) % count);
  s.labels = false;
  s.paint();
}

void step_set(Session& s, int step) {
  const int count = static_cast<int>(s.stored.size());
  if (count == 0) return s.say("the file holds no curvatures of its own");
  // The first press after a computation leads back to the set that was shown before.
  s.show_set(s.stored_shown ? static_cast<std::size_t>((static_cast<int>(s.set) + count + step) % count) : s.set);
}

void toggle_labels(Session& s) {
  if (s.data.labels.empty()) return s.say("there are no labels");
  s.labels = !s.labels;
  s.paint();
}

void set_range_factor(Session& s, double factor) {
  if (!s.has_data()) return;
  s.range_factor() = std::clamp(factor, 1 / kMostRange, kMostRange);
  if (!s.labels) s.window.scene().change_range(s.range());
  s.refresh();
}

void scale_range(Session& s, double factor) {
  if (s.has_data()) set_range_factor(s, factor * s.range_factor());
}

void toggle_ball(Session& s) {
  s.ball = !s.ball;
  s.show_pick();
  if (s.ball && !s.picked) return s.say("click on a point to see the measuring ball there");
  s.refresh();
}

void next_directions(Session& s) {
  const DirectionFields& fields = s.data.directions;
  if (fields.dir_min.empty() || fields.dir_max.empty()) return s.say("there are no principal directions");
  s.directions = static_cast<Directions>((static_cast<int>(s.directions) + 1) % 4);
  s.window.scene().show_directions(fields, s.directions, Execution{});
  s.refresh();
}

void toggle_edges(Session& s) {
  if (!s.scan.is_mesh()) return s.say("a cloud has no edges");
  s.edges = s.edges == Edges::Hidden ? Edges::Shown : Edges::Hidden;
  s.window.scene().show_edges(s.edges, Execution{});
  s.refresh();
}

void toggle_help(Session& s) {
  s.help = !s.help;
  s.refresh();
}

void reset_view(Session& s) {
  s.window.reset_view();
  s.refresh();
}

void pick_at_mouse(Session& s) {
  const std::array<int, 2> at = s.window.mouse();
  s.viewer.pick(at[0], at[1]);
}

void forget_pick(Session& s) {
  s.picked.reset();
  s.message.clear();
  s.show_pick();
  s.refresh();
}

/// Saves the window as the first of kappa-001.png, kappa-002.png ... that is not there yet.
void save_picture(Session& s) {
  std::string path;
  do {
    char name[32];
    std::snprintf(name, sizeof name, "kappa-%03d.png", ++s.pictures);
    path = (std::filesystem::path(s.options.picture_folder) / name).string();
  } while (std::filesystem::exists(path));
  s.message.clear();
  s.refresh();
  s.viewer.save_picture(path);
  s.say("saved " + path);
}

struct Action {
  const char* keysym;  ///< X name of the key
  void (*act)(Session&);
};

/// What one line of the help tells about.
struct Control {
  const char* input;  ///< what the user does
  const char* brief;  ///< in the line of keys; empty: not there
  const char* effect;
  std::vector<Action> actions;  ///< none for the mouse, which VTK and the window look after
};

/// All that the mouse and the keys do. Handling of keys, line of keys and help are made from this table alone.
const std::vector<Control>& controls() {
  static const std::vector<Control> kControls = {
      {"h", "all keys", "shows or hides this list", {{"h", toggle_help}}},
      {"drag", "", "turns the view", {}},
      {"Shift + drag", "", "moves the view", {}},
      {"wheel", "", "zooms", {}},
      {"slider", "", "measures at another radius as soon as it is let go", {}},
      {"click, p", "point", "picks the point under the mouse and shows its values", {{"p", pick_at_mouse}}},
      {"Escape", "", "forgets the picked point", {{"Escape", forget_pick}}},
      {"f, F",
       "field",
       "shows the next, the previous field",
       {{"f", [](Session& s) { step_field(s, 1); }}, {"F", [](Session& s) { step_field(s, -1); }}}},
      {"n, N",
       "",
       "shows the next, the previous radius stored in the file",
       {{"n", [](Session& s) { step_set(s, 1); }}, {"N", [](Session& s) { step_set(s, -1); }}}},
      {"l", "labels", "shows the labels or the field", {{"l", toggle_labels}}},
      {"[, ]",
       "colours",
       "narrows, widens the range of the colours",
       {{"bracketleft", [](Session& s) { scale_range(s, 1 / kRangeStep); }},
        {"bracketright", [](Session& s) { scale_range(s, kRangeStep); }}}},
      {"0", "", "makes the range of the colours automatic again", {{"0", [](Session& s) { set_range_factor(s, 1); }}}},
      {"b", "ball", "shows or hides the measuring ball at the picked point", {{"b", toggle_ball}}},
      {"d", "directions", "shows the principal directions: of k min, of k max, both, none", {{"d", next_directions}}},
      {"e", "edges", "shows or hides the edges of the faces", {{"e", toggle_edges}}},
      {"c, Print", "picture", "saves a picture of the window", {{"c", save_picture}, {"Print", save_picture}}},
      {"v", "view", "resets the view", {{"v", reset_view}}},
      {"q", "quit", "closes the window", {{"q", [](Session& s) { s.window.quit(); }}}}};
  return kControls;
}

/// "f F" where each key does something else, "c" where all do the same as c.
std::string brief_input(const Control& control) {
  std::string keys = control.input;
  const auto same = [&](const Action& action) { return action.act == control.actions.front().act; };
  if (std::all_of(control.actions.begin(), control.actions.end(), same)) return keys.substr(0, keys.find(','));
  keys.erase(std::remove(keys.begin(), keys.end(), ','), keys.end());
  return keys;
}

}  // namespace

bool press_key(Session& session, const std::string& keysym) {
  for (const Control& control : controls()) {
    for (const Action& action : control.actions) {
      if (action.keysym != keysym) continue;
      action.act(session);
      return true;
    }
  }
  return false;
}

std::vector<std::string> key_line() {
  std::vector<std::string> entries;
  for (const Control& control : controls()) {
    if (*control.brief == '\0') continue;
    entries.push_back(brief_input(control) + "  " + control.brief);
  }
  return entries;
}

std::string help_text() {
  std::string text;
  for (const Control& control : controls())
    text += (text.empty() ? "" : "\n") + std::string(control.input) + ":  " + control.effect;
  return text;
}

}  // namespace view_detail

std::string viewer_keys() {
  constexpr std::size_t kColumn = 16;
  std::string text = "Mouse and keys in the window:\n";
  for (const view_detail::Control& control : view_detail::controls()) {
    std::string input = control.input;
    input.resize(std::max(kColumn, input.size() + 2), ' ');
    text += "  " + input + control.effect + "\n";
  }
  return text;
}

}  // namespace kappa
