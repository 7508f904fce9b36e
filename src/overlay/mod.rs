//! What is drawn over scenes and pictures, as plain colours, boxes and lines; knows no window.

mod colormap;
mod heat;
mod legend;
mod text;

pub use colormap::{COLORMAPS, Colormap, colormap};
pub use heat::{HeatScale, Range, Scale, Tick, blend, heat_colors};
pub use legend::{Captions, HeatPicture, with_legend};
