// The Python module: the C++ interface as it is. cnctrans/__init__.py gives it the form that people use.
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>

#include "cnctrans/api.h"

namespace py = pybind11;
namespace api = cnctrans::api;

namespace {

/// Program files keep their bytes: no text of Python, which would have to be decoded.
py::bytes bytes_of(const api::Output& o) {
  return py::bytes(o.bytes);
}

api::Program program_of(const std::string& name, const std::optional<py::bytes>& bytes) {
  return bytes ? api::text(name, std::string(*bytes)) : api::file(name);
}

void bind_values(py::module_& m) {
  py::class_<api::Program>(m, "Program").def(py::init(&program_of), py::arg("name"), py::arg("bytes") = std::nullopt);
  py::class_<api::Dialect>(m, "Dialect")
      .def_readonly("name", &api::Dialect::name)
      .def_readonly("title", &api::Dialect::title)
      .def_readonly("read", &api::Dialect::read)
      .def_readonly("mill_extensions", &api::Dialect::mill_extensions)
      .def_readonly("lathe_extensions", &api::Dialect::lathe_extensions);
  py::class_<api::Place>(m, "Place")
      .def_readonly("file", &api::Place::file)
      .def_readonly("line", &api::Place::line)
      .def_readonly("column", &api::Place::column)
      .def_readonly("end_line", &api::Place::end_line)
      .def_readonly("end_column", &api::Place::end_column);
  py::enum_<api::Severity>(m, "Severity")
      .value("note", api::Severity::note)
      .value("warning", api::Severity::warning)
      .value("error", api::Severity::error);
  py::class_<api::Diagnostic>(m, "Diagnostic")
      .def_readonly("code", &api::Diagnostic::code)
      .def_readonly("severity", &api::Diagnostic::severity)
      .def_readonly("place", &api::Diagnostic::place)
      .def_readonly("message", &api::Diagnostic::message)
      .def_readonly("hint", &api::Diagnostic::hint)
      .def_readonly("shown", &api::Diagnostic::shown)
      .def("__str__", [](const api::Diagnostic& d) { return d.shown; });
  py::enum_<api::Status>(m, "Status")
      .value("ok", api::Status::ok)
      .value("refused", api::Status::refused)
      .value("usage", api::Status::usage)
      .value("differs", api::Status::differs);
}

void bind_options(py::module_& m) {
  py::enum_<api::Unsupported>(m, "Unsupported")
      .value("error", api::Unsupported::error)
      .value("warn", api::Unsupported::warn)
      .value("comment", api::Unsupported::comment);
  py::enum_<api::Numbering>(m, "Numbering")
      .value("keep", api::Numbering::keep)
      .value("none", api::Numbering::none)
      .value("renumber", api::Numbering::renumber);
  py::enum_<api::Cycles>(m, "Cycles")
      .value("native", api::Cycles::native)
      .value("exact", api::Cycles::exact)
      .value("explode", api::Cycles::explode);
  py::enum_<api::Encoding>(m, "Encoding")
      .value("as_source", api::Encoding::as_source)
      .value("utf8", api::Encoding::utf8)
      .value("windows1252", api::Encoding::windows1252);
  py::enum_<api::LineEnd>(m, "LineEnd")
      .value("as_source", api::LineEnd::as_source)
      .value("lf", api::LineEnd::lf)
      .value("crlf", api::LineEnd::crlf)
      .value("cr", api::LineEnd::cr);
  py::class_<api::Options>(m, "Options")
      .def_readwrite("machine", &api::Options::machine)
      .def_readwrite("libraries", &api::Options::libraries)
      .def_readwrite("programs", &api::Options::programs)
      .def_readwrite("set", &api::Options::set)
      .def_readwrite("skip", &api::Options::skip)
      .def_readwrite("max_events", &api::Options::max_events);
  py::class_<api::RunOptions, api::Options>(m, "RunOptions")
      .def(py::init<>())
      .def_readwrite("dialect", &api::RunOptions::dialect);
  py::class_<api::TranslateOptions, api::Options>(m, "TranslateOptions")
      .def(py::init<>())
      .def_readwrite("source", &api::TranslateOptions::from)
      .def_readwrite("target", &api::TranslateOptions::to)
      .def_readwrite("target_machine", &api::TranslateOptions::target_machine)
      .def_readwrite("unsupported", &api::TranslateOptions::unsupported)
      .def_readwrite("numbering", &api::TranslateOptions::numbering)
      .def_readwrite("number_step", &api::TranslateOptions::number_step)
      .def_readwrite("cycles", &api::TranslateOptions::cycles)
      .def_readwrite("raise_structure", &api::TranslateOptions::raise_structure)
      .def_readwrite("annotate", &api::TranslateOptions::annotate)
      .def_readwrite("origin", &api::TranslateOptions::origin)
      .def_readwrite("prove", &api::TranslateOptions::prove)
      .def_readwrite("verify", &api::TranslateOptions::verify)
      .def_readwrite("explore", &api::TranslateOptions::explore)
      .def_readwrite("one_file", &api::TranslateOptions::one_file)
      .def_readwrite("encoding", &api::TranslateOptions::encoding)
      .def_readwrite("line_end", &api::TranslateOptions::line_end);
}

void bind_results(py::module_& m) {
  py::class_<api::Output>(m, "Output")
      .def_readonly("name", &api::Output::name)
      .def_readonly("program", &api::Output::program)
      .def_property_readonly("bytes", &bytes_of)
      .def_readonly("main", &api::Output::main)
      .def_readonly("lines", &api::Output::lines);
  py::class_<api::Verdict> verdict(m, "Verdict");
  py::enum_<api::Verdict::Result>(verdict, "Result")
      .value("verified", api::Verdict::Result::verified)
      .value("within_tolerance", api::Verdict::Result::within_tolerance)
      .value("differs", api::Verdict::Result::differs)
      .value("nothing_to_compare", api::Verdict::Result::nothing_to_compare)
      .value("not_replayable", api::Verdict::Result::not_replayable);
  verdict.def_readonly("result", &api::Verdict::result)
      .def_readonly("events", &api::Verdict::events)
      .def_readonly("moves", &api::Verdict::moves)
      .def_readonly("max_length", &api::Verdict::max_length)
      .def_readonly("blocks", &api::Verdict::blocks)
      .def_readonly("replayed", &api::Verdict::replayed)
      .def_readonly("text", &api::Verdict::text)
      .def_property_readonly("good", &api::Verdict::good)
      .def("__str__", [](const api::Verdict& v) { return v.text; });
  py::class_<api::Translation>(m, "Translation")
      .def_readonly("status", &api::Translation::status)
      .def_readonly("error", &api::Translation::error)
      .def_readonly("outputs", &api::Translation::outputs)
      .def_readonly("diagnostics", &api::Translation::diagnostics)
      .def_readonly("verdict", &api::Translation::verdict)
      .def_readonly("source_machine", &api::Translation::source_machine)
      .def_readonly("target_machine", &api::Translation::target_machine);
  py::class_<api::Comparison>(m, "Comparison")
      .def_readonly("status", &api::Comparison::status)
      .def_readonly("error", &api::Comparison::error)
      .def_readonly("verdict", &api::Comparison::verdict)
      .def_readonly("diagnostics", &api::Comparison::diagnostics);
  py::class_<api::Run>(m, "Run")
      .def_readonly("status", &api::Run::status)
      .def_readonly("error", &api::Run::error)
      .def_readonly("reason", &api::Run::reason)
      .def_readonly("blocks", &api::Run::blocks)
      .def_readonly("events", &api::Run::events)
      .def_readonly("variables", &api::Run::variables)
      .def_readonly("diagnostics", &api::Run::diagnostics);
  py::class_<api::Check>(m, "Check")
      .def_readonly("status", &api::Check::status)
      .def_readonly("error", &api::Check::error)
      .def_readonly("lines", &api::Check::lines)
      .def_readonly("blocks", &api::Check::blocks)
      .def_readonly("blocks_read", &api::Check::blocks_read)
      .def_readonly("diagnostics", &api::Check::diagnostics);
}

/// Events go to Python in bundles, as lines: taking the interpreter's lock for each one would cost more than the run.
/// `sink` says whether it wants more.
api::Run run_in_bundles(const api::Program& program, const api::RunOptions& options,
                        const std::function<bool(py::bytes)>& sink) {
  constexpr std::size_t bundle_bytes = 1 << 16;
  std::string bundle;
  bool wanted = true;
  std::exception_ptr failed;  // of the sink: no exception may go through the run
  const auto pass_on = [&] {
    if (bundle.empty() || !wanted) return;
    const py::gil_scoped_acquire lock;
    try {
      wanted = sink(py::bytes(bundle));
    } catch (const std::exception&) {
      failed = std::current_exception();
      wanted = false;
    }
    bundle.clear();
  };
  api::Run done;
  {
    const py::gil_scoped_release free;
    done = api::run(program, options, [&](std::string_view json) {
      if (!wanted) return;
      bundle.append(json).push_back('\n');
      if (bundle.size() > bundle_bytes) pass_on();
    });
    pass_on();
  }
  if (failed) std::rethrow_exception(failed);
  return done;
}

}  // namespace

PYBIND11_MODULE(_cnctrans, m) {
  bind_values(m);
  bind_options(m);
  bind_results(m);
  const auto free = py::call_guard<py::gil_scoped_release>();
  m.def("version", &api::version);
  m.def("dialects", &api::dialects);
  m.def("machines", &api::machines);
  m.def("translate", &api::translate, py::arg("program"), py::arg("options"), free);
  m.def("verify", &api::verify, py::arg("source"), py::arg("translation"), py::arg("options"), free);
  m.def("check", &api::check, py::arg("program"), py::arg("options"), free);
  m.def("run", &run_in_bundles, py::arg("program"), py::arg("options"), py::arg("sink"));
}
