#include <placegraph/frontend/labels/label_options.h>

namespace placegraph {

void LabellerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LabellerOptions& o) {
  field("context", o.context,
        "whether a second forest uses the labels of neighbouring superpixels");
  field("field", o.field, "whether a random field favours equal labels for similar neighbours");
  field("relations", o.relations,
        "whether the field uses a table of the classes above and beside each class");
  field("rounds", o.rounds, "number of applications of the second forest", {1, 5});
}

}  // namespace placegraph
