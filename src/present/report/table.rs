//! Plain tables for a terminal.

use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};

/// Returns an empty table with a line under its titles. Columns from `first_number` on are right-aligned.
pub fn plain_table(titles: Vec<String>, first_number: usize) -> Table {
    let rule = LineStyle::none().fill('─').junction('─');
    let mut table = Table::new();
    table
        .load_style(TableStyle::new().header_separator(rule))
        .set_header(titles);
    for column in table.column_iter_mut().skip(first_number) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
