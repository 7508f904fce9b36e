//! Dividing cells by planes: the driver and what it keeps of cells, limits and arrays.

mod cell_objects;
mod driver;
mod error;
mod limits;
mod overlap;
mod part;

pub use driver::{Scope, divide};
pub use error::{BuildError, Inseparable};
