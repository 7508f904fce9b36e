//! Constants that several builders have.

use crate::structure::method::Constant;

pub const WIDTH: Constant = Constant {
    name: "width",
    default: 2.0,
    lowest: 2.0,
    highest: 8.0,
    step: 1.0,
    unit: "children",
    about: "Children per inner node at most. The hierarchy is built with two, then children of the largest \
            surface area are replaced by their own children until there are as many as this.",
    source: "I. Wald, C. Benthin and S. Boulos, Getting rid of packets, 2008",
};

pub const COST_TRAVERSAL: Constant = Constant {
    name: "cost-traversal",
    default: 1.2,
    lowest: 0.0,
    highest: 100.0,
    step: 0.0,
    unit: "",
    about: "Cost of visiting an inner node, relative to the costs of tests: two box tests.",
    source: "T. Aila, T. Karras and S. Laine, On quality metrics of bounding volume hierarchies, 2013",
};

pub const COST_TEST: Constant = Constant {
    name: "cost-test",
    default: 1.0,
    lowest: 0.0,
    highest: 100.0,
    step: 0.0,
    unit: "",
    about: "Cost of one intersection test.",
    source: "T. Aila, T. Karras and S. Laine, On quality metrics of bounding volume hierarchies, 2013",
};

pub const BLOCK: Constant = Constant {
    name: "block",
    default: 1.0,
    lowest: 1.0,
    highest: 64.0,
    step: 1.0,
    unit: "objects",
    about: "Objects that a kernel tests at once. The cost of a leaf counts blocks of this many objects, begun ones \
            as whole ones.",
    source: "ours: 8 suits the SIMD kernel",
};

pub const MAX_LEAF: Constant = Constant {
    name: "max-leaf",
    default: 8.0,
    lowest: 1.0,
    highest: 1e6,
    step: 1.0,
    unit: "objects",
    about: "A node with more objects is split even if a leaf would be cheaper, unless it is at depth D_MAX.",
    source: "madmann91/bvh, version 2",
};
