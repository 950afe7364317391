//! Tables for reading in a terminal.

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, LineStyle, Table};

/// A table whose first row is its header, with a rule below the header and one below the last row if `closed`. `on_the_right` selects
/// the right-aligned columns.
pub(crate) fn text_table(rows: &[Vec<String>], on_the_right: impl Fn(usize) -> bool, closed: bool) -> String {
    let line = LineStyle::none().fill('─').junction('─');
    let style = NOTHING.header_separator(line);
    let mut table = Table::new();
    table.load_style(if closed { style.bottom_border(line) } else { style }).set_header(&rows[0]).add_rows(&rows[1..]);
    for (_, column) in table.column_iter_mut().enumerate().filter(|(place, _)| on_the_right(*place)) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.trim_fmt()
}

/// The cells of each row of a table that are not empty.
#[cfg(test)]
pub(crate) fn cells(table: &str) -> Vec<Vec<&str>> {
    let rows = table.lines().filter(|line| !line.contains('─'));
    rows.map(|row| row.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()).collect()
}
