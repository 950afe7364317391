//! Tables in the format of the command, read into columns.

/// Columns that contain words even if all fields are empty; any other column has words only if a field is not a number.
const WORDS: [&str; 3] = ["cut", "status", "combination"];

/// A column of a table.
#[derive(Debug)]
pub struct Column {
    /// Name of the column, without the unit.
    pub name: String,
    /// Unit of the column; empty if the table has none.
    pub unit: String,
    /// Values of the column.
    pub values: Values,
}

/// The fields of a column.
#[derive(Debug)]
pub enum Values {
    /// Finite numbers; NaN where a field is empty.
    Numbers(Vec<f64>),
    /// Words.
    Words(Vec<String>),
}

/// The columns of a CSV table and its number of rows. The table has a header of names with units in brackets, followed by numbers, or by words where
/// a field is not a number.
///
/// # Errors
/// Rows of unequal lengths, or bytes that are not text; the error names the line.
pub fn columns_of(csv: &[u8]) -> Result<(Vec<Column>, usize), String> {
    let reader = || csv::Reader::from_reader(csv);
    let header = reader().headers().map_err(|error| error.to_string())?.clone();
    let mut columns: Vec<_> = header
        .iter()
        .map(|title| {
            let parts = title.strip_suffix(']').and_then(|title| title.split_once(" ["));
            let (name, unit) = parts.unwrap_or((title, ""));
            let values = if WORDS.contains(&name) { Values::Words(Vec::new()) } else { Values::Numbers(Vec::new()) };
            Column { name: name.to_owned(), unit: unit.to_owned(), values }
        })
        .collect();
    let mut rows = 0;
    let (mut first, mut record) = (reader(), csv::StringRecord::new());
    while first.read_record(&mut record).map_err(|error| error.to_string())? {
        for (column, _) in columns.iter_mut().zip(&record).filter(|(_, field)| number(field).is_none()) {
            column.values = Values::Words(Vec::new());
        }
        rows += 1;
    }
    let mut again = reader();
    while again.read_record(&mut record).map_err(|error| error.to_string())? {
        for (column, field) in columns.iter_mut().zip(&record) {
            match &mut column.values {
                Values::Numbers(numbers) => numbers.extend(number(field)),
                Values::Words(words) => words.push(field.to_owned()),
            }
        }
    }
    Ok((columns, rows))
}

/// The number in a field; an empty field is a missing value, NaN.
fn number(field: &str) -> Option<f64> {
    if field.is_empty() { Some(f64::NAN) } else { field.parse().ok().filter(|number: &f64| number.is_finite()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_has_its_name_its_unit_and_as_many_fields_as_there_are_rows() {
        let (columns, rows) = columns_of(b"t [s],m.n_rate [1/t_c],cut,note\n1.5,,,2\n2,-3e2,,x\n").unwrap();
        assert_eq!(rows, 2);
        let [time, pulse, cut, note] = &columns[..] else { panic!("{columns:?}") };
        assert_eq!([&time.name, &time.unit, &pulse.name, &pulse.unit], ["t", "s", "m.n_rate", "1/t_c"]);
        assert!(matches!(&time.values, Values::Numbers(numbers) if numbers[..] == [1.5, 2.0]));
        assert!(matches!(&pulse.values, Values::Numbers(numbers) if numbers[0].is_nan() && numbers[1..] == [-300.0]));
        assert!(matches!(&cut.values, Values::Words(words) if words[..] == ["", ""]));
        assert!(matches!(&note.values, Values::Words(words) if words[..] == ["2", "x"]));
    }
}
