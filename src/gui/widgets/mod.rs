//! Widgets that several panes share.

pub mod choice_list;
pub mod color_text;
pub mod coloring_bar;
pub mod common;
pub mod hidden;
pub mod linear_axis;
pub mod log_axis;
pub mod markdown;
pub mod progress_ring;
pub mod rounded;
pub mod rows;
pub mod scale_bar;
pub mod setting_widget;
pub mod sparkline;
pub mod step_text;
pub mod study_bar;
pub mod symbol;
pub mod transport;
pub mod tree_rows;
pub mod value_row;
pub mod visits_note;
