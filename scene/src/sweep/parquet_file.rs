//! A finished table as a Parquet file: `scene` is an integer, `status` a text, and every other column has doubles that may
//! be missing, stored as split byte streams under zstd.

use std::fmt;
use std::fs::File;
use std::io::Read;
use std::sync::Arc;

use parquet::basic::{Compression, ConvertedType, Encoding, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use super::{NUMBER, STATUS};

/// Numbers per row group: 32 MB before compression.
const NUMBERS_PER_GROUP: usize = 4 << 20;

/// Reasons why a table could not be written as Parquet.
#[derive(Debug)]
pub enum ConversionError {
    /// The table cannot be read.
    Table(csv::Error),
    /// A field that does not have the type of its column.
    Field(u64, String),
    /// The file cannot be written.
    Parquet(ParquetError),
}

struct Group {
    numbers: Vec<i64>,
    statuses: Vec<ByteArray>,
    /// For each other column its values and, for each row, whether there is one.
    columns: Vec<(Vec<f64>, Vec<i16>)>,
}

/// Writes the CSV table `table` to `file`. The same table gives the same bytes.
pub fn write_parquet(table: impl Read, file: &File) -> Result<(), ConversionError> {
    write_in_groups(table, file, NUMBERS_PER_GROUP)
}

fn write_in_groups(table: impl Read, file: &File, numbers_per_group: usize) -> Result<(), ConversionError> {
    let mut table = csv::Reader::from_reader(table);
    let header: Vec<_> = table.headers()?.iter().map(str::to_owned).collect();
    let fields = header.iter().map(|name| field(name).map(Arc::new)).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("sweep").with_fields(fields).build()?;
    let mut properties = WriterProperties::builder()
        .set_created_by(concat!("twofold ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?));
    for name in header.iter().filter(|name| *name != NUMBER && *name != STATUS) {
        let column = ColumnPath::new(vec![name.clone()]);
        properties = properties
            .set_column_dictionary_enabled(column.clone(), false)
            .set_column_encoding(column, Encoding::BYTE_STREAM_SPLIT);
    }
    let mut writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties.build()))?;
    let rows_per_group = (numbers_per_group / header.len()).max(1);
    let mut group = Group::new(header.len());
    let mut record = csv::StringRecord::new();
    while table.read_record(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line);
        group.take(&record, &header).map_err(|column| ConversionError::Field(line, column))?;
        if group.numbers.len() == rows_per_group {
            group.write(&header, &mut writer)?;
            group = Group::new(header.len());
        }
    }
    if !group.numbers.is_empty() {
        group.write(&header, &mut writer)?;
    }
    writer.close()?;
    Ok(())
}

fn field(name: &str) -> Result<Type, ParquetError> {
    let (physical, repetition, converted) = match name {
        NUMBER => (Physical::INT64, Repetition::REQUIRED, ConvertedType::NONE),
        STATUS => (Physical::BYTE_ARRAY, Repetition::REQUIRED, ConvertedType::UTF8),
        _ => (Physical::DOUBLE, Repetition::OPTIONAL, ConvertedType::NONE),
    };
    Type::primitive_type_builder(name, physical).with_repetition(repetition).with_converted_type(converted).build()
}

impl Group {
    fn new(columns: usize) -> Self {
        let columns = vec![(Vec::new(), Vec::new()); columns.saturating_sub(2)];
        Self { numbers: Vec::new(), statuses: Vec::new(), columns }
    }

    /// Adds a row, or names the column whose field has the wrong type.
    fn take(&mut self, record: &csv::StringRecord, header: &[String]) -> Result<(), String> {
        let mut columns = self.columns.iter_mut();
        for (name, text) in header.iter().zip(record) {
            let wrong = || name.clone();
            match name.as_str() {
                NUMBER => self.numbers.push(text.parse().map_err(|_| wrong())?),
                STATUS => self.statuses.push(text.into()),
                _ => {
                    let (values, present) = columns.next().ok_or_else(wrong)?;
                    present.push(i16::from(!text.is_empty()));
                    if !text.is_empty() {
                        values.push(text.parse().map_err(|_| wrong())?);
                    }
                }
            }
        }
        Ok(())
    }

    fn write(&self, header: &[String], writer: &mut SerializedFileWriter<&File>) -> Result<(), ParquetError> {
        let mut group = writer.next_row_group()?;
        let mut columns = self.columns.iter();
        for name in header {
            let Some(mut column) = group.next_column()? else { break };
            match (name.as_str(), columns.as_slice().first()) {
                (NUMBER, _) => column.typed::<Int64Type>().write_batch(&self.numbers, None, None)?,
                (STATUS, _) => column.typed::<ByteArrayType>().write_batch(&self.statuses, None, None)?,
                (_, Some((values, present))) => {
                    columns.next();
                    column.typed::<DoubleType>().write_batch(values, Some(present), None)?
                }
                (_, None) => 0,
            };
            column.close()?;
        }
        group.close()?;
        Ok(())
    }
}

impl fmt::Display for ConversionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ConversionError::Table(error) => write!(f, "the table cannot be read: {error}"),
            ConversionError::Field(line, column) => {
                write!(f, "line {line} of the table holds no number in the column `{column}`")
            }
            ConversionError::Parquet(error) => write!(f, "the Parquet file cannot be written: {error}"),
        }
    }
}

impl std::error::Error for ConversionError {}

impl From<csv::Error> for ConversionError {
    fn from(error: csv::Error) -> Self {
        ConversionError::Table(error)
    }
}

impl From<ParquetError> for ConversionError {
    fn from(error: ParquetError) -> Self {
        ConversionError::Parquet(error)
    }
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    /// The file of a table, with `numbers` per group.
    fn read(table: &str, numbers: usize) -> Result<SerializedFileReader<File>, ConversionError> {
        let file = tempfile::tempfile().expect("a file");
        write_in_groups(table.as_bytes(), &file, numbers)?;
        Ok(SerializedFileReader::new(file).expect("a Parquet file"))
    }

    #[test]
    fn every_number_comes_back_and_missing_ones_are_missing() {
        let table =
            "scene,star.spin,status,e_z_X@1.0 [1]\n0,0.1,ok,-1.5e-300\n1,1e22,failed,\n2,-0.0,ok,0.30000000000000004\n";
        let expected = [
            (0, 0.1, "ok", Field::Double(-1.5e-300)),
            (1, 1e22, "failed", Field::Null),
            (2, -0.0, "ok", Field::Double(0.30000000000000004)),
        ];
        // All rows in one group; two and one; one row per group, also if it has more numbers than a group should.
        for (numbers, groups) in
            [(NUMBERS_PER_GROUP, vec![3]), (11, vec![2, 1]), (4, vec![1, 1, 1]), (1, vec![1, 1, 1])]
        {
            let reader = read(table, numbers).expect("a table");
            let rows_of_groups: Vec<_> = reader.metadata().row_groups().iter().map(|group| group.num_rows()).collect();
            assert_eq!(rows_of_groups, groups, "{numbers} numbers to a group");
            let rows: Vec<_> = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row")).collect();
            assert_eq!(rows.len(), expected.len());
            for (row, (number, spin, status, value)) in rows.iter().zip(&expected) {
                let fields: Vec<_> =
                    row.get_column_iter().map(|(name, field)| (name.as_str(), field.clone())).collect();
                let wanted = [
                    ("scene", Field::Long(*number)),
                    ("star.spin", Field::Double(*spin)),
                    ("status", Field::Str(status.to_string())),
                    ("e_z_X@1.0 [1]", value.clone()),
                ];
                assert_eq!(fields, wanted);
            }
        }
    }

    #[test]
    fn numbers_are_split_streams_under_zstd() {
        let reader = read("scene,star.spin,status\n0,0.1,ok\n", NUMBERS_PER_GROUP).expect("a table");
        let metadata = reader.metadata();
        let column = metadata.row_group(0).column(1);
        assert!(column.encodings().any(|encoding| encoding == Encoding::BYTE_STREAM_SPLIT));
        assert_eq!(column.dictionary_page_offset(), None);
        assert!(matches!(column.compression(), Compression::ZSTD(_)));
        let by = concat!("twofold ", env!("CARGO_PKG_VERSION"));
        assert_eq!(metadata.file_metadata().created_by(), Some(by));
        assert_eq!(metadata.file_metadata().schema().name(), "sweep");
    }

    #[test]
    fn tables_without_rows_have_no_group() {
        let reader = read("scene,star.spin,status\n", NUMBERS_PER_GROUP).expect("a table");
        assert_eq!(reader.metadata().num_row_groups(), 0);
        assert_eq!(reader.metadata().file_metadata().schema().get_fields().len(), 3);
    }

    #[test]
    fn errors_name_what_is_wrong() {
        let told = |table: &str| read(table, NUMBERS_PER_GROUP).err().expect("an error").to_string();
        let bad = told("scene,star.spin,status\n0,x,ok\n");
        assert_eq!(bad, "line 2 of the table holds no number in the column `star.spin`");
        let bad = told("scene,star.spin,status\n0,0.1,ok\n1.5,0.1,ok\n");
        assert_eq!(bad, "line 3 of the table holds no number in the column `scene`");
        let short = told("scene,star.spin,status\n0,0.1\n");
        assert!(short.starts_with("the table cannot be read: ") && short.contains("line: 2"), "{short}");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.parquet");
        std::fs::write(&path, "").expect("a file");
        let read_only = File::open(&path).expect("a file to read");
        let refused =
            write_parquet("scene,star.spin,status\n0,0.1,ok\n".as_bytes(), &read_only).expect_err("not to be written");
        assert!(refused.to_string().starts_with("the Parquet file cannot be written: "), "{refused}");
    }
}
