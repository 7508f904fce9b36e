//! Counters: everything that is specified, counted or timed. A counter is one entry of [`COUNTERS`];
//! parameters, heatmaps and the figures of each kind of ray are views of that list.

mod class;
mod declaration;
mod list;
mod parameter;
mod ray_figure;

pub use class::{Class, Table, Unit};
pub use declaration::{Count, Counter, Quantity, Value};
pub use list::COUNTERS;
pub use parameter::{ACROSS_STRUCTURES, DELTA, LAMBDA, Parameter, parameter, parameters};
pub use ray_figure::{RayFigure, ray_figures};
