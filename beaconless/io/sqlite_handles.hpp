// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

struct sqlite3;
struct sqlite3_stmt;

namespace beaconless::io {

struct SqliteClose {
  void operator()(sqlite3* database) const;
};
struct SqliteFinalize {
  void operator()(sqlite3_stmt* statement) const;
};

/// What SQLite hands out, given back when it is let go.
using SqliteHandle = std::unique_ptr<sqlite3, SqliteClose>;
using SqliteStatement = std::unique_ptr<sqlite3_stmt, SqliteFinalize>;

}  // namespace beaconless::io
