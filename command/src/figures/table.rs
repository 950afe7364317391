//! The data of a figure as columns of numbers.

use super::markup::plain;

#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name that distinguishes it from other tables of its figure; empty if it is the only one.
    pub name: String,
    /// Headers with units, `t [t_c]`.
    pub columns: Vec<String>,
    /// Rows with one number per column.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// An empty table with the given headers, and a name that loses its markup.
    pub(super) fn new<C: Into<String>>(name: impl Into<String>, columns: impl IntoIterator<Item = C>) -> Self {
        Self { name: plain(&name.into()), columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    pub(super) fn push(&mut self, row: impl Into<Vec<f64>>) {
        let row = row.into();
        debug_assert_eq!(row.len(), self.columns.len(), "a number for each column of {}", self.name);
        self.rows.push(row);
    }

    /// The points of column `y` against column `x`, by index.
    pub(super) fn points(&self, x: usize, y: usize) -> Vec<(f64, f64)> {
        self.rows.iter().map(|row| (row[x], row[y])).collect()
    }

    /// Comma-separated values; numbers have the fewest digits that identify the double.
    pub fn csv(&self) -> String {
        let mut text = self.columns.join(",") + "\n";
        for row in &self.rows {
            text += &(row.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_with_the_digits_that_identify_them() {
        let mut table = Table::new("", ["t [s]", "x [1]"]);
        table.push([1.0, -2.5e-300]);
        table.push([0.1, 1.0 / 3.0]);
        assert_eq!(table.csv(), "t [s],x [1]\n1.0,-2.5e-300\n0.1,0.3333333333333333\n");
    }
}
