// Commands of a page to the viewer: one JSON object per message, {"do": NAME, ...}.
//
//   set         pane, key, value     a setting: integrator, mode, cache, denoiser, backend
//   parameter   pane, name, value    one of the method's parameters, or another setting of the pane
//                                    (page_settings.h), such as its seed; value null: the default
//   camera      to_world, yfov?      16 numbers, column-major, rigid; metres, radians
//   resolution  width, height        pixels
//   transport   name, value          a setting of all panes (page_settings.h), such as those of
//                                    light transport; null: its default
//   light       name, factor         factor on the radiance of a light of the scene
//   material    name, key, value, bases?  a parameter or the kind of a [[material]] of the scene
//                                    file, as TOML; null: the file's. bases: 1 is the scene file
//                                    that it begins with, and so on
//   layer       pane, name           shows a layer of the method over its image; "": none
//   probe       pane, x, y           asks for what the pane keeps for a pixel
//   pause       on                   stops the panes; the reference goes on
//   look        on, panes?           whether the page is visible; a hidden page gets no images
//                                    and causes no rendering. panes: those that it shows (default:
//                                    all); others render nothing
//   adaptive    on                   whether frames are smaller while the camera moves
//   restart                          restarts the histories, with the next seed
//   copy        from, to             gives the pane `to` the method of the pane `from`
//   undo, redo                       one step back or forth in the settings
//   save        name?                saves the settings as a suite
//   measure     name?                saves the suite and starts `restlab run` on it
//   cancel                           ends the running measurement
//   picture     image                saves the image as it was rendered, an EXR; from the number of
//                                    panes on: the reference
//   table       name                 shows another table of a folder of results
//
// Panes are numbered from 0. The parser only checks that numbers are finite and bounded and that
// texts are short. Names that a method or a scene does not know are refused when the command is
// run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/frame/part.h"

namespace restlab {

struct SetSetting {
  uint32_t pane = 0;
  std::string key, value;
};
struct SetParameter {
  uint32_t pane = 0;
  std::string name;
  std::optional<ParameterValue> value;  // empty: the default
};
struct MoveCamera {
  std::array<double, 16> toWorld{};  // column-major
  std::optional<double> yfov;
};
struct Resize {
  uint32_t width = 0, height = 0;
};
struct SetTransport {
  std::string name;
  std::optional<ParameterValue> value;  // empty: the default
};
struct SetLight {
  std::string name;
  double factor = 1.0;
};
struct SetMaterial {
  std::string name, key;
  std::optional<std::string> value;  // empty: the file's
  uint32_t bases = 0;                // ListedMaterial::bases
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
  uint64_t panes = ~uint64_t(0);  // bits
};
struct AdaptMotion {
  bool on = true;
};
struct Restart {};
struct CopyMethod {
  uint32_t from = 0, to = 0;  // panes
};
struct Undo {};
struct Redo {};
struct SaveSession {
  std::string name;  // name of the suite; "": made from the scene and the time
};
struct Measure {
  std::string name;
};
struct CancelMeasure {};
struct SavePicture {
  uint32_t image = 0;
};
struct ShowTable {
  std::string name;
};

using ViewCommand =
    std::variant<SetSetting, SetParameter, MoveCamera, Resize, SetTransport, SetLight, SetMaterial,
                 ShowLayer, Probe, Pause, Look, AdaptMotion, Restart, CopyMethod, Undo, Redo,
                 SaveSession, Measure, CancelMeasure, SavePicture, ShowTable>;

// Panes of methods.
constexpr uint32_t kMostPanes = 2;
// Images of files that a page shows without a scene, besides their reference.
constexpr uint32_t kMostImages = 64;
constexpr uint32_t kMostBases = 16;

// Throws Error (badUsage) with one line: the mistake and what would be right.
ViewCommand parseViewCommand(const std::string& text);
// True if the command changes the content or the making of frames: the frame under way is useless.
bool changesFrames(const ViewCommand& command);

}  // namespace restlab
