// Fields of the statements, the routines and the program; see ir/fields.h.
#pragma once

#include "ir/fields.h"

namespace cnctrans::ir::detail {

template <class V, Is<Block> T>
void fields(V& v, T& x) {
  v.block(x);
}
template <class V, Is<Assign> T>
void fields(V& v, T& x) {
  v.assignments("items", x.items);
}
template <class V, Is<If> T>
void fields(V& v, T& x) {
  v.item("condition", x.condition);
  v.flag("one_line", x.one_line);
  v.then_else(x);
}
template <class V, Is<While> T>
void fields(V& v, T& x) {
  v.item("condition", x.condition);
  v.body("body", x.body, x.end_line);
}
/// The condition stands in the closing line.
template <class V, Is<Until> T>
void fields(V& v, T& x) {
  v.body("body", x.body, x.end_line);
  v.word("until");
  v.item("condition", x.condition);
}
template <class V, Is<For> T>
void fields(V& v, T& x) {
  v.item("counter", x.counter);
  v.word("=");
  v.item("from", x.from);
  v.word("to");
  v.item("to", x.to);
  v.opt("step", x.step);
  v.body("body", x.body, x.end_line);
}
template <class V, Is<Loop> T>
void fields(V& v, T& x) {
  v.body("body", x.body, x.end_line);
}
template <class V, Is<Exit> T>
void fields(V&, T&) {}
template <class V, Is<Jump> T>
void fields(V& v, T& x) {
  v.label("target", x.target);
  v.opt("if", x.condition);
  v.opt("search", x.search, Search::whole_first);
  v.flag("quiet", x.quiet);
}
template <class V, Is<Switch> T>
void fields(V& v, T& x) {
  v.item("value", x.value);
  v.cases("cases", x.cases);
  v.each("default", x.fallback);
}
template <class V, Is<Repeat> T>
void fields(V& v, T& x) {
  v.label("first", x.first);
  v.label("last", x.last);
  v.opt("count", x.count);
  v.opt("search", x.search, Search::whole_first);
  v.flag("order_free", x.order_free);
  v.flag("in", x.has_program);
  if (x.has_program) v.routine_name("program", x.program);
  v.opt("curve_use", x.curve_use, CurveUse::none);
  v.opt("curve", x.curve);
}
/// The value of an argument, or the variable it hands over.
template <class V, Is<Argument> T>
void fields(V& v, T& x) {
  v.opt("name", x.name);
  v.flag("ref", x.by_reference);
  if (x.by_reference) v.item("reference", x.reference);
  v.opt("value", x.value);
}
template <class V, Is<CallRoutine> T>
void fields(V& v, T& x) {
  v.routine_name("routine", x.routine);
  v.opt("computed", x.computed);
  v.arguments("arguments", x.arguments);
  v.bare("level", x.level, CallLevel::shared);
  v.opt("count", x.count);
  v.flag("range", x.has_range);
  if (x.has_range) {
    v.label("first", x.first);
    v.label("last", x.last);
  }
  v.flag("tail", x.tail);
  v.flag("optional", x.optional);
}
template <class V, Is<ModalCall> T>
void fields(V& v, T& x) {
  v.flag("off", x.off);
  v.flag("here", x.here);
  v.group("call", x.call);
  v.pointer("cycle", x.cycle);
}
template <class V, Is<Return> T>
void fields(V& v, T& x) {
  v.exprs("values", x.values);
  v.quoted("text", x.text);
}
template <class V, Is<End> T>
void fields(V& v, T& x) {
  v.flag("returns_from_sub", x.returns_from_sub);
  v.quoted("text", x.text);
}
template <class V, Is<Message> T>
void fields(V& v, T& x) {
  v.item("kind", x.kind);
  v.exprs("parts", x.parts);
  v.opt("number", x.number);
  v.opt("into_file", x.file_line);
  v.opt("file_use", x.file_use, FileUse::line);
}
template <class V, Is<Declare> T>
void fields(V& v, T& x) {
  v.item("type", x.type);
  v.opt("spelt", x.type_text);
  v.word("in");
  v.space("space", x.space);
  v.declared("items", x.items);
}
template <class V, Is<Label> T>
void fields(V&, T&) {}
template <class V, Is<Opaque> T>
void fields(V& v, T& x) {
  v.item("text", x.text);
  v.opt("feature", x.feature);
  v.flag("harmless", x.harmless);
}

// --- the program ------------------------------------------------------------------------------------------------

template <class V, Is<SpaceSegment> T>
void fields(V& v, T& x) {
  v.item("lo", x.lo);
  v.item("hi", x.hi);
  v.bare("scope", x.scope, Scope::global);
  v.flag_off("forgotten", "persistent", x.persistent);
  v.flag("read_only", x.read_only);
  v.flag("stops_preparation", x.stops_preparation);
  v.flag("zero_points", x.zero_points);
}
template <class V, Is<VariableSpace> T>
void fields(V& v, T& x) {
  v.item("prefix", x.prefix);
  v.opt("scope", x.scope, Scope::routine);
  v.opt("type", x.type, Type::real);
  v.flag("starts_at_zero", x.starts_at_zero);
  v.each("segment", x.segments);
}
template <class V, Is<Parameter> T>
void fields(V& v, T& x) {
  v.item("name", x.name);
  v.opt("type", x.type, Type::real);
  v.opt("spelt", x.type_text);
  v.flag("by_reference", x.by_reference);
  v.opt("default", x.default_value);
  v.word("sets");
  v.item("variable", x.variable);
}
/// Of the line that opens it; the body is not among them.
template <class V, Is<Routine> T>
void fields(V& v, T& x) {
  v.item("kind", x.kind);
  v.routine_name("name", x.name);
  v.opt("locality", x.locality, Locality::global);
  v.opt("title", x.title);
  v.opt("attributes", x.attributes);
  v.opt("header_text", x.header_text);
  v.opt("file", x.file, 0U);
  v.flag("has_signature", x.has_signature);
  v.flag("saves_modals", x.saves_modals);
  v.each("param", x.parameters);
}
template <class V, Is<FileLook> T>
void fields(V& v, T& x) {
  v.item("file", x.file);
  v.item("name", x.name);
  v.opt("encoding", x.encoding, Encoding::utf8);
  v.opt("eol", x.eol, Eol::lf);
  v.flag("bom", x.bom);
  v.flag_off("no_final_eol", "final_eol", x.final_eol);
  v.each("leader", x.leader);
  v.opt("trailer", x.trailer);
  v.flag("archive", x.archive);
}
/// Of the first line; axis names, spaces, files and routines have lines of their own.
template <class V, Is<Program> T>
void fields(V& v, T& x) {
  v.item("dialect", x.dialect);
  v.opt("unit_hint", x.unit_hint, Units::metric);
  v.flag("lathe", x.lathe);
}

}  // namespace cnctrans::ir::detail
