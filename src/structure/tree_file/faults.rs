//! What is wrong with the tree of a file, counted, with the first place of each kind.

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// `leaf` is neither 0 nor 1.
    LeafFlag,
    /// An inner node has fewer than two children, or more than the width.
    ChildCount,
    /// The children of a node are outside the array `child`, or a child is not a node.
    ChildIndex,
    /// A node is below itself.
    Cycle,
    /// A node has two parents.
    TwoParents,
    /// A leaf is too deep.
    Depth,
    /// The references of a leaf are outside the array `ref`, or are too many.
    ReferenceIndex,
    /// A reference to an object that does not exist.
    ObjectIndex,
    /// `stop` is not an index of the header's `stops`.
    Stop,
    /// A number is infinite or not a number.
    NotFinite,
    /// The box of a part of an object has its lower corner above its upper one.
    Inverted,
    /// An axis is not 0, 1 or 2.
    Axis,
    /// A plane does not divide its cell.
    Plane,
    /// The planes of a grid do not extend through the root cell.
    Grid,
    /// A node is not below the root.
    Unreached,
    /// A leaf refers to an object twice.
    Repeated,
    /// The box of a node extends beyond that of its parent.
    Outside,
    /// No leaf refers to an object.
    Lost,
    /// The boxes of the leaves that refer to an object do not contain it.
    Uncovered,
}

impl FaultKind {
    /// Returns whether no tree can be made of a file with this fault.
    pub fn is_fatal(self) -> bool {
        self < FaultKind::Unreached
    }
}

/// A kind of fault with its number and its first place.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    pub kind: FaultKind,
    pub count: u64,
    /// The first one: node or object, and what is wrong there.
    pub first: String,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.first)?;
        match self.count {
            0 | 1 => Ok(()),
            2 => f.write_str(" (and 1 more like this)"),
            count => write!(f, " (and {} more like this)", count - 1),
        }
    }
}

/// All faults of a tree, in the order in which they were found first. Displayed as one line per kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// Counts a fault. `text` says where and what it is; it is only called for the first of a kind.
    pub(super) fn add(&mut self, kind: FaultKind, text: impl FnOnce() -> String) {
        match self.0.iter_mut().find(|fault| fault.kind == kind) {
            Some(fault) => fault.count += 1,
            None => self.0.push(Fault {
                kind,
                count: 1,
                first: text(),
            }),
        }
    }

    /// Returns one entry per kind that was found.
    pub fn list(&self) -> &[Fault] {
        &self.0
    }

    /// Returns whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns whether no tree can be made of the file.
    pub fn are_fatal(&self) -> bool {
        self.0.iter().any(|fault| fault.kind.is_fatal())
    }
}

impl std::fmt::Display for Faults {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (i, fault) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{fault}")?;
        }
        Ok(())
    }
}
