// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/io/temp_folder.hpp"

namespace beaconless {

using Words = std::vector<std::string>;

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// What a program printed, and how it ended.
struct Ran {
  int exit_code = -1;  ///< 128 and the signal's number when a signal ended it
  std::string out;
  std::string err;
  long peak_memory_kb = 0;

  /// The one JSON object that is all of `out`; null when it is anything else.
  nlohmann::json json() const {
    const auto object = nlohmann::json::parse(out, nullptr, false);
    return object.is_object() ? object : nlohmann::json();
  }
};

inline void PrintTo(const Ran& ran, std::ostream* out) {
  *out << "exit code " << ran.exit_code << "\nstdout: " << ran.out << "\nstderr: " << ran.err;
}

/// Runs a program to its end, at most two minutes; nothing on its standard input.
inline Ran run_program(const TempFolder& folder, const std::string& program, const Words& words) {
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::string out = folder.path("stdout.txt");
  const std::string err = folder.path("stderr.txt");
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return {-1, "", program + " cannot be run"};

  int status = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  rusage used{};
  while (wait4(child, &status, WNOHANG, &used) == 0) {
    if (std::chrono::steady_clock::now() > deadline) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), folder.read("stdout.txt"),
          folder.read("stderr.txt"), used.ru_maxrss};
}

/// A test that runs the real `beaconless` in a folder of its own.
class Program : public testing::Test {
 protected:
  Ran run(const Words& words) const { return run_program(folder, BEACONLESS_PROGRAM, words); }

  TempFolder folder;
};

}  // namespace beaconless
