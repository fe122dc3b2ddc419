#include "backends/num/backend.h"

#include <charconv>

#include "backends/common/comments.h"
#include "backends/common/stream_writer.h"
#include "backends/num/style.h"
#include "backends/num/writer.h"
#include "dialects/num/limits.h"

namespace cnctrans::backends::num {

namespace {

/// Straight-line programs: the header, then plain blocks.
class NumStream final : public PlainStreamWriter {
 public:
  explicit NumStream(const WriteOptions& options)
      : PlainStreamWriter(num::style(), options, plain_words(*options.profile)), stem_(options.main_stem) {}

 protected:
  void header(const ir::Program& frame, std::string& out) override {
    const ir::Routine* main = frame.main();
    if (same_dialect() && (main == nullptr || !main->header.span.known())) return;
    std::int64_t n = main != nullptr ? main->name.number : -1;
    if (n < dialects::num::program_min || n > dialects::num::program_max) {
      n = 0;
      std::from_chars(stem_.data(), stem_.data() + stem_.size(), n);
      if (n < dialects::num::program_min || n > dialects::num::program_max) n = 1;
    }
    std::string head = '%' + std::to_string(n);
    const std::size_t comments = head.size();
    if (main != nullptr && !main->title.empty())
      head += ' ' + comment(main->title, num::style().comment, same_dialect(), nullptr);
    out += wrapped(head, comments, num::style().comment, same_dialect() ? 0 : num::style().line_length) + '\n';
  }

 private:
  std::string stem_;
};

class NumBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return "num"; }
  [[nodiscard]] const ir::Capabilities& capabilities() const override { return num::capabilities(false, true, true); }
  [[nodiscard]] const ir::Capabilities& capabilities_for(const machine::Profile& target) const override {
    return num::capabilities(target.kind == machine::Kind::lathe, later_family(target), structured(target));
  }
  std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                Diagnostics& diagnostics) const override {
    return Writer(program, options, diagnostics).write();
  }
  std::unique_ptr<StreamWriter> stream(const WriteOptions& options) const override {
    return std::make_unique<NumStream>(options);
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<NumBackend>();
}

}  // namespace cnctrans::backends::num
