//! Reads a table from a Parquet file, row by row.
//!
//! Each cell becomes the text that the same value has in CSV, so that both formats are parsed by the same code. A float
//! becomes the shortest text that reads back to the same bits.

mod cell_kind;
mod cell_texts;
mod guard;
mod page_check;
#[cfg(test)]
mod tests;

use crate::csv_records::add_record;
use crate::error::{ParquetProblem, TableError};
use crate::position::RowPosition;
use crate::records::Records;
use cell_kind::CellKind;
use cell_texts::ColumnTexts;
use guard::guarded;
use page_check::CheckedPages;
use parquet::basic::Compression;
use parquet::column::reader::get_column_reader;
use parquet::file::metadata::RowGroupMetaData;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::schema::types::SchemaDescriptor;
use std::fmt;

/// A table that is read row by row from a Parquet file.
///
/// Columns hold numbers, text or booleans. An absent value is an empty cell. The checksum is computed from the texts of
/// the cells.
pub(super) struct ParquetRecords<R: ChunkReader + 'static> {
    file: SerializedFileReader<R>,
    file_byte_count: u64,
    /// The number of rows of each row group.
    group_row_counts: Vec<u64>,
    file_row_count: u128,
    header: Vec<String>,
    cell_kinds: Vec<CellKind>,
    next_group: usize,
    /// The rows that are decoded at present; `None` between two row groups.
    group: Option<RowGroup>,
    record: csv::ByteRecord,
    row_count: usize,
    checksum: crc32fast::Hasher,
}

/// The rows of a row group that are not read yet; some of them are decoded.
struct RowGroup {
    index: usize,
    columns: Vec<ColumnTexts>,
    /// The number of rows that are not decoded yet.
    undecoded_row_count: u64,
    /// The number of rows in memory as text.
    decoded_row_count: usize,
    /// The index among these of the next row to return.
    next_decoded: usize,
}

/// The number of rows that are in memory as text at the same time.
const DECODED_ROW_COUNT: usize = 1024;

impl<R: ChunkReader + 'static> ParquetRecords<R> {
    /// Opens the table, and reads the names and types of its columns.
    ///
    /// # Errors
    /// [`TableError::Parquet`], [`TableError::ColumnType`].
    pub(super) fn new(input: R) -> Result<Self, TableError> {
        let file_byte_count = input.len();
        let file = guarded(|| SerializedFileReader::new(input))
            .map_err(|error| parquet_error(None, None, &error))?;
        let schema = file.metadata().file_metadata().schema_descr();
        let header = column_names(schema);
        let cell_kinds = cell_kinds(schema)?;
        let groups = file.metadata().row_groups();
        let group_row_counts = groups.iter().enumerate();
        let group_row_counts: Vec<u64> = group_row_counts
            .map(|(index, group)| check_group(index, group, &header))
            .collect::<Result<_, _>>()?;
        let mut checksum = crc32fast::Hasher::new();
        add_record(&mut checksum, &csv::ByteRecord::from(header.clone()));
        Ok(ParquetRecords {
            file,
            file_byte_count,
            file_row_count: group_row_counts.iter().copied().map(u128::from).sum(),
            group_row_counts,
            header,
            cell_kinds,
            next_group: 0,
            group: None,
            record: csv::ByteRecord::new(),
            row_count: 0,
            checksum,
        })
    }

    /// Opens the next row group that has rows; `None` after the last one.
    fn open_group(&mut self) -> Result<Option<RowGroup>, TableError> {
        let counts = self.group_row_counts.get(self.next_group..);
        let mut later = counts.unwrap_or_default().iter();
        let Some(skipped) = later.position(|&count| count > 0) else {
            return Ok(None);
        };
        let index = self.next_group + skipped;
        self.next_group = index + 1;
        let columns = (0..self.header.len()).map(|column| self.open_column(index, column));
        Ok(Some(RowGroup {
            index,
            columns: columns.collect::<Result<_, _>>()?,
            undecoded_row_count: self.group_row_counts[index],
            decoded_row_count: 0,
            next_decoded: 0,
        }))
    }

    fn open_column(&self, group: usize, column: usize) -> Result<ColumnTexts, TableError> {
        let descriptor = self.file.metadata().file_metadata().schema_descr();
        let descriptor = descriptor.column(column);
        let pages = guarded(|| {
            let group = self.file.get_row_group(group)?;
            group.get_column_page_reader(column)
        });
        let pages = pages
            .map_err(|error| parquet_error(Some(group), Some(&self.header[column]), &error))?;
        let pages = CheckedPages::new(pages, &descriptor, self.group_row_counts[group]);
        let reader = get_column_reader(descriptor.clone(), Box::new(pages));
        let kind = self.cell_kinds[column];
        Ok(ColumnTexts::new(reader, kind, descriptor.max_def_level()))
    }

    /// Moves to the next row, and decodes more rows if necessary. Returns whether there is a next row.
    fn move_to_next_row(&mut self) -> Result<bool, TableError> {
        loop {
            let group = match &mut self.group {
                Some(group) => group,
                None => match self.open_group()? {
                    Some(group) => self.group.insert(group),
                    None => return Ok(false),
                },
            };
            if group.next_decoded < group.decoded_row_count {
                let row = group.next_decoded;
                group.next_decoded += 1;
                self.record.clear();
                for column in &group.columns {
                    self.record.push_field(column.cell(row));
                }
                return Ok(true);
            }
            if !group.decode_more(&self.header)? {
                self.group = None;
            }
        }
    }
}

impl RowGroup {
    /// Decodes the next rows. Returns whether there are more rows.
    fn decode_more(&mut self, header: &[String]) -> Result<bool, TableError> {
        let remaining = usize::try_from(self.undecoded_row_count).unwrap_or(usize::MAX);
        let count = remaining.min(DECODED_ROW_COUNT);
        for (column, name) in self.columns.iter_mut().zip(header) {
            guarded(|| column.decode(count))
                .map_err(|error| parquet_error(Some(self.index), Some(name), &error))?;
        }
        self.undecoded_row_count -= count as u64;
        (self.decoded_row_count, self.next_decoded) = (count, 0);
        Ok(count > 0)
    }
}

impl<R: ChunkReader + 'static> Records for ParquetRecords<R> {
    type Record = csv::ByteRecord;

    fn header(&self) -> Result<Vec<String>, TableError> {
        Ok(self.header.clone())
    }

    fn current(&self) -> &csv::ByteRecord {
        &self.record
    }

    fn advance(&mut self) -> Result<Option<RowPosition>, TableError> {
        match self.move_to_next_row() {
            Ok(true) => {}
            Ok(false) => return Ok(None),
            Err(error) => {
                // Rows after damage are not read: their cells could come from different rows.
                (self.group, self.next_group) = (None, self.group_row_counts.len());
                return Err(error);
            }
        }
        add_record(&mut self.checksum, &self.record);
        let row = self.row_count;
        self.row_count += 1;
        Ok(Some(RowPosition { row, line: None }))
    }

    fn checksum(&self) -> u32 {
        self.checksum.clone().finalize()
    }

    /// Returns the fraction of the file that corresponds to the fraction of the rows: a row's bytes are not in one place.
    fn consumed_bytes(&self) -> u64 {
        let fraction = u128::from(self.file_byte_count) * self.row_count as u128;
        u64::try_from(fraction / self.file_row_count.max(1)).unwrap_or(self.file_byte_count)
    }
}

/// Returns the names of the columns, without the spaces around them, as the CSV reader does.
fn column_names(schema: &SchemaDescriptor) -> Vec<String> {
    let fields = schema.root_schema().get_fields().iter();
    fields.map(|field| field.name().trim().to_owned()).collect()
}

/// Returns how the cells of each column become text. Without lists and structs, columns are the fields of the schema.
fn cell_kinds(schema: &SchemaDescriptor) -> Result<Vec<CellKind>, TableError> {
    let columns = schema.columns().iter();
    let kinds = columns.map(|column| {
        CellKind::of(column).map_err(|found| TableError::ColumnType {
            column: column.path().parts().first().cloned().unwrap_or_default(),
            found,
        })
    });
    kinds.collect()
}

/// Returns the number of rows of a row group. Refuses a row group that lacks columns, or is compressed in a way that
/// cannot be read.
fn check_group(
    index: usize,
    group: &RowGroupMetaData,
    header: &[String],
) -> Result<u64, TableError> {
    if group.num_columns() != header.len() {
        let problem = format!("has {} of {} columns", group.num_columns(), header.len());
        return Err(parquet_error(Some(index), None, &problem));
    }
    for (column, name) in group.columns().iter().zip(header) {
        let codec = match column.compression() {
            Compression::UNCOMPRESSED
            | Compression::SNAPPY
            | Compression::GZIP(_)
            | Compression::LZ4_RAW => continue,
            Compression::ZSTD(_) if cfg!(feature = "zstd") => continue,
            Compression::ZSTD(_) => "zstd, which this build leaves out (its feature is `zstd`)",
            _ => "another method than snappy, gzip, lz4_raw and zstd",
        };
        let problem = format!("is compressed with {codec}; write the table with snappy");
        return Err(parquet_error(Some(index), Some(name), &problem));
    }
    u64::try_from(group.num_rows()).map_err(|_| {
        let problem = format!("has {} rows", group.num_rows());
        parquet_error(Some(index), None, &problem)
    })
}

fn parquet_error(
    row_group: Option<usize>,
    column: Option<&str>,
    problem: &dyn fmt::Display,
) -> TableError {
    TableError::Parquet(ParquetProblem {
        row_group,
        column: column.map(str::to_owned),
        problem: problem.to_string(),
    })
}
