//! Formats numbers for people.
//!
//! The window and the messages of the command line use [`Digits`] and [`ChangeText`]: a chosen number
//! of significant digits, units that fit the size, spaces that no line break splits. Reports and
//! exports keep the form of the paper's tables: plain numbers beside a column of units, changes as
//! the second value relative to the first.

mod change;
mod digits;
mod paper;
mod value;

pub use change::{ChangeText, Direction};
pub use digits::{Digits, NO_VALUE, OTHER_UNIT, counted, grouped};
pub use paper::significant;
