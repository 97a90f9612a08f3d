// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// A pass without events, for a file that could be opened before and no longer can; the reason is reported.
inline std::unique_ptr<EventStream> failed_pass(const Error& error,
                                                const std::function<void(const Problem&)>& on_problem) {
  struct NoEvents : EventStream {
    std::optional<Event> next() override { return std::nullopt; }
  };
  if (on_problem) on_problem({error.where, error.what});
  return std::make_unique<NoEvents>();
}

}  // namespace beaconless::io
