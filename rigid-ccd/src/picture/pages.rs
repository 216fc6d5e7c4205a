//! A folder with one page for each of some rows.

use super::{Asked, PageError, Painter, ViewError};
use crate::batch::Bodies;
use crate::table::courses::Movements;
use crate::table::results::ResultRow;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A folder of pages, one for each row, named by the row's id.
pub struct Pages<'a> {
    painter: Painter<'a>,
    title: String,
    folder: PathBuf,
    names: HashSet<String>,
}

/// The error of a page that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum PagesError {
    /// The row cannot be drawn.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The file of the page cannot be written.
    #[error(transparent)]
    Page(#[from] PageError),
}

impl<'a> Pages<'a> {
    /// Creates the folder if it does not exist.
    ///
    /// # Errors
    /// The folder cannot be created.
    pub fn create(
        bodies: Bodies<'a>,
        asked: Asked,
        title: String,
        folder: &Path,
    ) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        Ok(Pages {
            painter: Painter::new(bodies, asked),
            title,
            folder: folder.to_owned(),
            names: HashSet::new(),
        })
    }

    /// Returns the number of pages written so far.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Writes the page of a row, and returns its path.
    ///
    /// # Errors
    /// [`PagesError`].
    pub fn write(&mut self, course: &Movements, row: &ResultRow) -> Result<PathBuf, PagesError> {
        let view = self.painter.view(course, row)?;
        let name = self.name(&row.id);
        let path = self.folder.join(name);
        // Browser tabs show the beginning of a title.
        let title = format!("{} ({}): {}", row.id, row.status.name(), self.title);
        self.painter.page(&title, vec![view]).write(&path)?;
        Ok(path)
    }

    /// Returns a unique file name for an id, also on file systems that ignore case.
    fn name(&mut self, id: &str) -> String {
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.') {
                c
            } else {
                '_'
            }
        };
        // A leading dot hides a file, and file systems limit names to 255 bytes.
        let stem: String = id
            .trim_start_matches('.')
            .chars()
            .map(plain)
            .take(100)
            .collect();
        let numbered = |count| match count {
            0 if stem.is_empty() => "row".to_owned(),
            0 => stem.clone(),
            count => format!("{stem}-{count}"),
        };
        let mut names = (0..).map(numbered);
        let name = names.find(|name| self.names.insert(name.to_ascii_lowercase()));
        name.unwrap_or_default() + ".html"
    }
}

#[cfg(test)]
mod tests;
