// Folders of `restlab run` as tables.
#include <string>
#include <vector>

#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/python/values.h"
#include "experiments/runner/results/results_folder.h"
#include "experiments/runner/tables/csv.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

struct Cell {
  std::string name;
  ColumnValue value;
};
using Row = std::vector<Cell>;

std::vector<Row> rowsOf(const std::string& folder) {
  std::vector<Row> all;
  const ResultsFolder results = openResults(folder);
  for (const PlannedBlock& planned : results.plan) {
    if (planned.jobs.empty() && planned.images.empty()) continue;
    const LoadedBlock block = loadBlock(results, planned);
    if (block.result.methods.empty()) continue;
    const std::vector<MethodSummary> rows = summarise(suiteOf(results, planned), block.result);
    if (rows.empty()) continue;
    const Columns columns = columnsOf(rows);
    const std::vector<CsvField> fields = csvFields(columns);
    for (const MethodSummary& summary : rows) {
      Row row;
      for (const CsvField& field : fields) row.push_back({field.name, field.value(summary)});
      all.push_back(std::move(row));
    }
  }
  return all;
}

py::object objectOf(const ColumnValue& value) {
  if (const uint64_t* count = std::get_if<uint64_t>(&value)) return py::int_(*count);
  if (const Interval* number = std::get_if<Interval>(&value)) return py::float_(number->value);
  return strOf(std::get<std::string>(value));
}

// Returns pandas, or None where it is not installed.
py::object pandas() {
  try {
    return py::module_::import("pandas");
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) throw;
    return py::none();
  }
}

py::object load(const py::object& folder, bool asDicts) {
  const std::string name = textOf(folder, "folder");
  const std::vector<Row> rows = withoutPython([&] { return rowsOf(name); });
  py::list dicts;
  for (const Row& row : rows) {
    py::dict dict;
    for (const Cell& cell : row) dict[strOf(cell.name)] = objectOf(cell.value);
    dicts.append(dict);
  }
  const py::object module = asDicts ? py::object(py::none()) : pandas();
  return module.is_none() ? py::object(dicts) : module.attr("DataFrame")(dicts);
}

}  // namespace

void addResults(py::module_& module) {
  module.def("load_results", &load, py::arg("folder"), py::kw_only(), py::arg("as_dicts") = false,
             "The summary of a folder that `restlab run` left, a row a method and scene, with the "
             "columns of summary.csv:\na pandas.DataFrame, or a list of dicts where pandas is "
             "missing or as_dicts is set. Unknown numbers are nan.");
}

}  // namespace restlab::python
