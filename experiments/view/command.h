// What a page asks of the viewer: one JSON object a message, {"do": NAME, ...}.
//
//   set         pane, key, value     a setting: integrator, mode, cache, denoiser, backend
//   parameter   pane, name, value    one of the method's parameters; value null: its default
//   camera      to_world, yfov?      16 numbers, column by column, rigid; metres, radians
//   resolution  width, height        pixels
//   light       name, factor         on the radiance of a light of the scene
//   layer       pane, name           a layer of the method over its image; "": none
//   probe       pane, x, y           what the pane keeps of a pixel
//   pause       on                   panes stand; the reference goes on
//   look        on                   whether somebody sees the page; one that nobody does gets no
//                                    images, and keeps nothing at work
//   restart                          histories begin anew, with the next seed
//   copy        from, to             the pane `to` gets the method of the pane `from`
//   undo, redo                       the last step of what is set, back and forth
//   save        name?                what is set, as a suite
//   measure     name?                the same, and `restlab run` on it
//   cancel                           ends what is measured
//   picture     image                what is shown there as it was rendered, an EXR
//
// Panes are numbered from 0; the image after those of panes is the reference. What a method or a
// scene does not know, whoever runs the command says; here numbers are finite and bounded, and
// texts short.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/part.h"

namespace restlab {

struct SetSetting {
  uint32_t pane = 0;
  std::string key, value;
};
struct SetParameter {
  uint32_t pane = 0;
  std::string name;
  std::optional<ParameterValue> value;  // nothing: the default
};
struct MoveCamera {
  std::array<double, 16> toWorld{};  // column by column
  std::optional<double> yfov;
};
struct Resize {
  uint32_t width = 0, height = 0;
};
struct SetLight {
  std::string name;
  double factor = 1.0;
};
struct ShowLayer {
  uint32_t pane = 0;
  std::string name;
};
struct Probe {
  uint32_t pane = 0, x = 0, y = 0;
};
struct Pause {
  bool on = true;
};
struct Look {
  bool on = true;
};
struct Restart {};
struct CopyMethod {
  uint32_t from = 0, to = 0;  // panes
};
struct Undo {};
struct Redo {};
struct SaveSession {
  std::string name;  // of the suite; "": of the scene and the time
};
struct Measure {
  std::string name;
};
struct CancelMeasure {};
struct SavePicture {
  uint32_t image = 0;
};

using ViewCommand = std::variant<SetSetting, SetParameter, MoveCamera, Resize, SetLight, ShowLayer,
                                 Probe, Pause, Look, Restart, CopyMethod, Undo, Redo, SaveSession,
                                 Measure, CancelMeasure, SavePicture>;

constexpr uint32_t kMostPanes = 2;

// Throws Error (badUsage) with one line: what is wrong and what would be right.
ViewCommand parseViewCommand(const std::string& text);
// It changes what frames show or how they are made: the one under way is of no use any more.
bool changesFrames(const ViewCommand& command);

}  // namespace restlab
