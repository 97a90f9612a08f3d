// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/complaints.hpp"

#include <utility>

namespace beaconless::ros1 {

bool Complaints::raise(const std::string& subject, Level level, std::string words, double now_s,
                       double lasts_s) {
  const auto [at, is_new] = all_.try_emplace(subject);
  Complaint& complaint = at->second;
  const bool is_worth_saying = is_new || level > complaint.level || now_s - complaint.logged_s > kSayAgain_s;
  complaint.level = level;
  complaint.words = std::move(words);
  complaint.until_s = now_s + lasts_s;
  if (is_worth_saying) complaint.logged_s = now_s;
  return is_worth_saying;
}

const std::map<std::string, Complaints::Complaint>& Complaints::at(double now_s) {
  std::erase_if(all_, [&](const auto& of) { return of.second.until_s < now_s; });
  return all_;
}

}  // namespace beaconless::ros1
