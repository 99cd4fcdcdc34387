// Every setting that a method, its pane and all panes have is set in the panels, and read back from
// the state and from the record of the frame that it was rendered with.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "core/frame/method_settings.h"
#include "experiments/view/page_settings.h"
#include "experiments/view/picture_file.h"
#include "experiments/view/view_session.h"
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

// Names with the values that a page shows.
using Words = std::map<std::string, std::string>;

std::string wordOf(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return std::to_string(value.get<int64_t>());
  if (value.is_number()) return parameterText(value.get<double>());
  return value.get<std::string>();
}

// Settings of the Vulkan backend alone.
const std::set<std::string> kOfVulkan = {"device", "validate"};

class PageSettingsTest : public LivePageTest {
 protected:
  // Opens a page with a method of many parameters.
  void openMany() {
    std::vector<SessionConfig> panes = smallPanes();
    panes[0] = smallPane("restir_pt", "svgf_restir");
    panes[0].cache = "voxel";
    for (SessionConfig& pane : panes) {
      pane.width = 32;
      pane.height = 18;
      pane.kernels = KernelChoice::builtIn;
    }
    serve(panes);
    open(*browser_);
    page("window.ofVulkan = " + Json(kOfVulkan).dump() + R"(;
      // Values of pane A and of all panes, by name.
      window.values = () => {
        const {panes: [pane], transport} = page.state;
        return Object.fromEntries([...pane.parameters, ...transport].map(
            one => [one.name, one.value]));
      };
      // Gives a control another value, as a hand does.
      window.change = control => {
        const {info} = control;
        const input = control.element.querySelector('input:not([type=range]), select');
        if (input.type === 'checkbox') return input.click();
        if (input.tagName === 'SELECT') {
          input.selectedIndex = (input.selectedIndex + 1) % input.options.length;
        } else {
          const step = !info.isReal ? 1 : (info.range[1] - info.range[0]) / 64;
          const value = info.value + step > info.range[1] ? info.value - step : info.value + step;
          input.value = value;
        }
        input.dispatchEvent(new Event('change'));
      };
      window.controls = () => [...page.methods.panes[0].controls.values(),
                               ...page.scene.settings.values()];)");
  }
  // Values of pane A and of all panes in the record of pane A's last frame.
  Words record() {
    const std::filesystem::path file = folder() / "picture.exr";
    std::ofstream(file, std::ios::binary) << pictureBytes(*view_, 0);
    Words words;
    for (const auto& [key, value] : readExr(file).metadata) {
      const std::string prefix = "parameter.";
      words[key.starts_with(prefix) ? key.substr(prefix.size()) : key] = value;
    }
    words["kernels"] = words.at("kernel");
    words["threads"] = std::to_string(view_->session(0).config().threads);
    return words;
  }
};

TEST_F(PageSettingsTest, EverySettingIsInTheRecordOfTheFrame) {
  openMany();
  const Json before = page("return values();");
  page(R"(const all = controls().filter(({info}) => !ofVulkan.includes(info.name));
    all.forEach(change);
    const before = )" +
       before.dump() + R"(;
    await until(() => all.every(({info: {name}}) => values()[name] !== before[name]));)");
  EXPECT_EQ(page("return document.querySelectorAll('.message.error').length;"), 0);
  const Json after = page("return values();");
  EXPECT_GT(after.size(), 55u) << "that many parameters";
  // Undone one after another they are as at first; the address brings all of them back.
  page(
      "const text = () => decodeURIComponent(location.hash);"
      "await until(() => text().includes('\"seed\":2') && text().includes('direct'));"
      "window.kept = location.hash;"
      "for (const name in values()) if (!ofVulkan.includes(name)) send({do: 'undo'});"
      "await until(() => !page.state.can_undo);");
  EXPECT_EQ(page("return values();"), before);
  page(
      "await until(() => location.hash !== kept); location.hash = kept;"
      "const wanted = " +
      after.dump() +
      ";"
      "await until(() => Object.entries(wanted).every(([name, value]) => "
      "values()[name] === value));"
      "const {epoch} = page.state;"
      "await until(() => page.last.epoch >= epoch && page.last.panes[0].frame > 0);");
  stop();
  const Words words = record();
  for (const auto& [name, value] : after.items()) {
    if (kOfVulkan.count(name) == 0) {
      EXPECT_NE(value, before.at(name)) << name;
      std::string word = words.at(name);
      if (value.is_boolean()) word = word == "on" ? "true" : word == "off" ? "false" : word;
      EXPECT_EQ(word, wordOf(value)) << name;
    }
  }
  // The saved session has them, too.
  const std::filesystem::path file = folder() / "saved.toml";
  std::ofstream(file) << sessionToml(facts_, *view_, "saved");
  const ViewStart start = startOfSuite(file);
  for (size_t i = 0; i < view_->panes(); ++i) {
    const SessionConfig &is = start.settings.panes[i].config,
                        &was = view_->settings().panes[i].config;
    EXPECT_TRUE(isSameMethod(is, was)) << i;
    EXPECT_EQ(is.seed, was.seed);
    const Method method = findMethod(was);
    EXPECT_EQ(resolveParameters(method, is.parameters), resolveParameters(method, was.parameters));
  }
  LiveView again(start.prepared, start.settings, {});
  EXPECT_EQ(again.firstSeed(), view_->firstSeed()) << "the same reference";
}

TEST_F(PageSettingsTest, IndirectLightIsOneClickAway) {
  open();
  // Not by the pointer: the numbers above get their height with the first frames.
  page("document.querySelector('.light-choice [data-value=indirect]').click();");
  page("await until(() => page.state.transport[0].value === 'indirect');");
  EXPECT_EQ(page("return document.querySelector('.light-choice [aria-pressed=true]')"
                 ".textContent;"),
            "indirect");
  press("i");
  page("await until(() => page.state.transport[0].value === 'all');");
  press("i");
  page(
      "await until(() => page.state.transport[0].value === 'indirect');"
      "await until(() => page.last.reference && page.last.reference.spp > 1);");
  stop();
  EXPECT_EQ(view_->session(1).config().components, uint32_t(rl::RL_COMPONENT_INDIRECT));
  EXPECT_EQ(view_->reference().whole().metadata.at("component"), "indirect")
      << "errors are against that light";
}

TEST_F(PageSettingsTest, WhatHasNoEffectIsGreyAndSaysWhy) {
  open();
  const std::string of = "document.querySelector('[data-parameter=spatial_radius]')";
  EXPECT_EQ(page("return " + of + ".classList.contains('unused');"), false);
  page(
      "send({do: 'parameter', pane: 0, name: 'spatial_neighbours', value: 0});"
      "await until(() => " +
      of + ".classList.contains('unused'));");
  EXPECT_EQ(page("return " + of + ".querySelector('.why').textContent;"),
            "no effect: spatial_neighbours is 0");
  EXPECT_EQ(page("return Array.from(document.querySelectorAll('[aria-label=\"Pane A\"] "
                 "[data-part=reuse] .why:not([hidden])'), one => "
                 "one.parentElement.dataset.parameter);"),
            (Json{"donor_noise", "spatial_feedback", "spatial_radius"}))
      << "neighbours say it once";
  EXPECT_EQ(page("return " + of + ".querySelector('input').disabled;"), false)
      << "it can be set before it has one";
  // The method's own group is first; a folded one stays folded, and a search opens it.
  const std::string groups =
      "Array.from(document.querySelectorAll('[aria-label=\"Pane A\"] details.part'), "
      "one => one.dataset.part)";
  EXPECT_EQ(page("return " + groups + ".slice(0, 2);"), (Json{"restir_gi", "reuse"}));
  const std::string open = "return document.querySelector('[data-part=reuse]').open;";
  EXPECT_EQ(page(open), true);
  // Not by the pointer: the numbers above change their height while frames come.
  page("document.querySelector('[data-part=reuse] > summary').click();");
  EXPECT_EQ(page(open), false);
  page("page.methods.search.value = 'cap'; page.methods.filter();");
  EXPECT_EQ(page(open), true);
  page("page.methods.search.value = ''; page.methods.filter();");
  EXPECT_EQ(page(open), false);
}

}  // namespace
}  // namespace restlab::view_test
