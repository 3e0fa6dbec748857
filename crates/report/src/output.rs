//! Output folders, files and progress bars.

use std::fs;
use std::io::Write;
use std::path::Path;

use indicatif::{ProgressBar, ProgressStyle};

use crate::error::Error;
use crate::out_file::OutFile;

/// Creates a folder and its parents where they are missing.
pub(crate) fn create_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(|source| Error::CreateFolder { path: path.to_owned(), source })
}

/// Creates a file that appears whole or not at all.
pub(crate) fn create_file(path: &Path) -> Result<OutFile, Error> {
    OutFile::create(path).map_err(|source| Error::WriteFile { path: path.to_owned(), source })
}

/// Writes a text file.
pub(crate) fn write_file(path: &Path, text: &str) -> Result<(), Error> {
    let mut file = create_file(path)?;
    let written = file.write_all(text.as_bytes()).and_then(|()| file.finish());
    written.map_err(|source| Error::WriteFile { path: path.to_owned(), source })
}

/// Returns a progress bar of `length` steps on standard error; it stays hidden where that is no
/// terminal.
pub fn progress(length: u64, unit: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(&format!("{{wide_bar}} {{pos}} of {{len}} {unit}, {{eta}} left"))
        .expect("the template uses only keys of indicatif");
    ProgressBar::new(length).with_style(style)
}
