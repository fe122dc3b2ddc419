#include "ir/statement.h"

namespace cnctrans::ir {

StatementNode::StatementNode() = default;
StatementNode::StatementNode(const StatementNode&) = default;
StatementNode::StatementNode(StatementNode&&) noexcept = default;
StatementNode& StatementNode::operator=(const StatementNode&) = default;
StatementNode& StatementNode::operator=(StatementNode&&) noexcept = default;
StatementNode::~StatementNode() = default;

}  // namespace cnctrans::ir
