// A running viewer on another thread, with two small panes.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/base/error.h"
#include "experiments/view/view_loop.h"
#include "tests/runner/temporary_folder.h"
#include "tests/view/page.h"
#include "tests/view/small_panes.h"

namespace restlab::view_test {

class ViewLoopTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    facts_.request.scene = "cornell-box";
  }

  void start() {
    start(settingsOf(prepareScene(facts_.request),
                     {smallPane("restir_gi"), smallPane("path", "accumulate")}));
  }
  void start(const ViewSettings& settings) {
    view_.emplace(prepareScene(facts_.request), settings, ReferenceStore{});
    ViewServerOptions options;
    options.page = "the page";
    loop_ = std::make_unique<ViewLoop>(*view_, facts_, options, folder(), tev_);
    thread_ = std::thread([this] {
      try {
        loop_->run();
      } catch (const std::exception& error) {
        ADD_FAILURE() << "the loop has ended: " << error.what();
      }
    });
  }

  // Ends the loop: afterwards the test may use the view.
  void stop() {
    if (!thread_.joinable()) return;
    loop_->stop();
    thread_.join();
  }

  void TearDown() override {
    stop();
    loop_.reset();
    view_.reset();
    TemporaryFolder::TearDown();
  }

  std::string url() const { return loop_->url(); }

  // Writes a shell script to run instead of `restlab run SUITE -o FOLDER --json`.
  std::filesystem::path program(const std::string& lines) const {
    const std::filesystem::path file = folder() / "program";
    std::ofstream(file) << "#!/bin/sh\n" << lines << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }

  ViewFacts facts_;
  std::optional<TevAddress> tev_;  // passed to the loop
  std::optional<LiveView> view_;
  std::unique_ptr<ViewLoop> loop_;
  std::thread thread_;
};

}  // namespace restlab::view_test
