// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/sqlite_handles.hpp"

#include <sqlite3.h>

namespace beaconless::io {

void SqliteClose::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void SqliteFinalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

}  // namespace beaconless::io
