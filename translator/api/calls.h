// The calls of the public interface on the options of the house: what the C++ and the C interface share.
#pragma once

#include "cnctrans/api.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

api::Translation translate_for(const Input& input, const TranslateOptions& options) noexcept;
api::Comparison verify_for(const Input& source, const std::vector<Input>& targets,
                           const TranslateOptions& options) noexcept;
api::Run run_for(const Input& input, const RunOptions& options, const api::EventSink& sink) noexcept;
api::Check check_for(const Input& input, const RunOptions& options) noexcept;

Input input_of(const api::Program& program);

}  // namespace cnctrans::translator
