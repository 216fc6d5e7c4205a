//! Checks the pages of a Parquet file before they are decoded.
//!
//! The decoders reserve memory for as many values as a page claims to have. A damaged page may claim so many that the
//! process would end.

use parquet::basic::Encoding;
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::errors::ParquetError;
use parquet::schema::types::ColumnDescriptor;

/// The pages of a column, each checked before it is given.
pub(super) struct CheckedPages {
    pages: Box<dyn PageReader>,
    /// Whether values may be absent, so that levels are stored before the values.
    has_levels: bool,
    /// The number of rows of the row group.
    row_count: u64,
    has_dictionary: bool,
}

impl CheckedPages {
    /// Checks the pages of a column of a row group with `row_count` rows.
    pub(super) fn new(
        pages: Box<dyn PageReader>,
        column: &ColumnDescriptor,
        row_count: u64,
    ) -> Self {
        CheckedPages {
            pages,
            has_levels: column.max_def_level() > 0,
            row_count,
            has_dictionary: false,
        }
    }

    fn check(&mut self, page: &Page) -> Result<(), ParquetError> {
        let count = u64::from(page.num_values());
        if let Page::DictionaryPage { buf, .. } = page {
            self.has_dictionary = true;
            // Each value takes one byte at least.
            return refuse_too_many_values(count, buf.len() as u64);
        }
        refuse_too_many_values(count, self.row_count)?;
        match page.encoding() {
            Encoding::RLE_DICTIONARY | Encoding::PLAIN_DICTIONARY if !self.has_dictionary => {
                Err(damaged("a page needs a dictionary, and there is none"))
            }
            Encoding::DELTA_LENGTH_BYTE_ARRAY => {
                let values = self.values(page).ok_or_else(|| damaged("a page is cut"))?;
                let claimed = delta_value_count(values).ok_or_else(|| damaged("a page is cut"))?;
                refuse_too_many_values(claimed, count)
            }
            // The number of its suffixes cannot be known before its prefixes are decoded.
            Encoding::DELTA_BYTE_ARRAY => Err(ParquetError::NYI(
                "the encoding DELTA_BYTE_ARRAY is not read; write the table with another one"
                    .to_owned(),
            )),
            _ => Ok(()),
        }
    }

    /// Returns the values of a page, which follow its levels; `None` if the page is too short.
    fn values<'p>(&self, page: &'p Page) -> Option<&'p [u8]> {
        let start = match page {
            Page::DataPageV2 {
                def_levels_byte_len,
                rep_levels_byte_len,
                ..
            } => u64::from(*def_levels_byte_len) + u64::from(*rep_levels_byte_len),
            _ if !self.has_levels => 0,
            _ => {
                let length = page.buffer().first_chunk::<4>()?;
                4 + u64::from(u32::from_le_bytes(*length))
            }
        };
        page.buffer().get(usize::try_from(start).ok()?..)
    }
}

impl PageReader for CheckedPages {
    fn get_next_page(&mut self) -> Result<Option<Page>, ParquetError> {
        let page = self.pages.get_next_page()?;
        if let Some(page) = &page {
            self.check(page)?;
        }
        Ok(page)
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        self.pages.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.pages.skip_next_page()
    }

    fn at_record_boundary(&mut self) -> Result<bool, ParquetError> {
        self.pages.at_record_boundary()
    }
}

impl Iterator for CheckedPages {
    type Item = Result<Page, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

/// Returns the number of values in the header of delta-coded numbers, which is its third number; `None` if it is cut.
fn delta_value_count(bytes: &[u8]) -> Option<u64> {
    let mut bytes = bytes.iter();
    let mut next_number = || {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = *bytes.next()?;
            number |= u64::from(byte & 0x7f).checked_shl(shift)?;
            if byte < 0x80 {
                return Some(number);
            }
        }
        None
    };
    (next_number()?, next_number()?, next_number()?).2.into()
}

fn refuse_too_many_values(claimed: u64, max_count: u64) -> Result<(), ParquetError> {
    if claimed > max_count {
        return Err(damaged(&format!(
            "a page claims {claimed} values, and can have {max_count}"
        )));
    }
    Ok(())
}

fn damaged(problem: &str) -> ParquetError {
    ParquetError::General(problem.to_owned())
}
