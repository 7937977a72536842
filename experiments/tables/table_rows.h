// Tables that may be larger than the memory.
#pragma once

#include <filesystem>
#include <functional>

#include "experiments/tables/table.h"

namespace irk {

/// Calls `take` for every row of a table in its order, as readTable gives them; memory holds one row at a time. `names`
/// has the head and the columns, and no rows; it is returned, too. Throws what readTable throws.
Table forEachRow(const std::filesystem::path& path, const std::function<void(const Table& names, TableRow row)>& take);

}  // namespace irk
