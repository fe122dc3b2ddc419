// Lines for a program of the control: WRITE and DELETE (reference-language 9.2).
#include <cctype>
#include <string>

#include "backends/sinumerik/writer.h"
#include "base/text.h"
#include "ir/edit/file_line.h"
#include "legaliser/data/written_files.h"

namespace cnctrans::backends::sinumerik {

namespace {

/// A block of words that every control with ISO blocks reads alike; what it says becomes the same block here.
class PlainWords {
 public:
  /// The first word that is another thing here, or stands for more than it says; empty: none.
  std::string other(const std::vector<ir::ExprPtr>& parts) {
    for (const auto& p : parts) {
      const auto* s = p ? std::get_if<ir::String>(&p->node) : nullptr;
      if (s != nullptr)
        text(s->text);
      else
        value();
      if (!other_.empty()) return other_;
    }
    close();
    return other_;
  }

 private:
  void text(const std::string& t) {
    for (const char c : t) {
      if (comment_ || !other_.empty()) return;
      const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
      const bool number = std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
      if (letter || c == ';') {
        close();
        letter_ = letter ? c : 0;
        comment_ = c == ';';
      } else if (number && letter_ != 0 && !computed_) {
        digits_ += c;
      } else if (c != ' ' && c != '\t') {
        other_ = std::string(1, c);
      }
    }
  }
  void value() {
    if (comment_ || letter_ == 0 || !digits_.empty() || computed_) {
      other_ = "a value";
      return;
    }
    computed_ = true;
  }
  /// The word ends here.
  void close() {
    if (letter_ == 0) return;
    const char l = static_cast<char>(std::toupper(static_cast<unsigned char>(letter_)));
    const auto n = parse_decimal(digits_);
    bool same = computed_ || n.has_value();
    if (l == 'G') same = !computed_ && n && one_of(*n, {0, 1, 2, 3, 17, 18, 19, 40, 90, 91, 94, 95});
    if (l == 'M') same = !computed_ && n && one_of(*n, {0, 1, 2, 3, 4, 5, 8, 9, 30});
    if (l == 'N') same = !computed_ && n;
    if (!same || std::string_view("GMNXYZIJKFS").find(l) == std::string_view::npos) other_ = letter_ + digits_;
    letter_ = 0;
    digits_.clear();
    computed_ = false;
  }
  static bool one_of(double n, std::initializer_list<int> list) {
    for (const int i : list) {
      if (n == i) return true;
    }
    return false;
  }

  char letter_ = 0;
  std::string digits_;
  bool computed_ = false, comment_ = false;
  std::string other_;
};

}  // namespace

void Writer::file_statement(const ir::Message& m, const ir::FileStatement& f) {
  const auto* name = f.name ? std::get_if<ir::String>(&f.name->node) : nullptr;
  if (name == nullptr) return ProgramWriter::file_statement(m, f);
  const std::string begin = '(' + std::string(ir::passes::file_outcome) + ",\"" + name->text + '"';
  if (f.use == ir::FileUse::replace) return add("DELETE" + begin + ')', Rank::head);
  if (const std::string other = PlainWords().other(m.parts); !other.empty()) {
    return refuse("TRN-570", {},
                  "a line for a program of the control holds '" + other + "', which is not the same here",
                  "only blocks of G0 to G3, G90, G91, planes, X Y Z I J K F S and usual M functions are translated");
  }
  const std::string line = text_parts(m.parts);
  if (refused_problem()) return;
  add("WRITE" + begin + ',' + line + ')', Rank::head);
}

}  // namespace cnctrans::backends::sinumerik
