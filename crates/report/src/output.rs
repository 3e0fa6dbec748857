//! Output folders, files and progress bars.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::error::Error;
use crate::out_file::OutFile;

/// Time after which an action counts as long.
const LONG: Duration = Duration::from_secs(2);
/// Time between two pictures of a line that waits.
const TICK: Duration = Duration::from_millis(200);

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

/// Runs an action. Once it takes long, a line on standard error shows what it is and for how long.
/// It stays hidden where that is no terminal.
pub fn waiting<T>(text: &'static str, action: impl FnOnce() -> T) -> T {
    let (sender, done) = channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            if done.recv_timeout(LONG) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed} so far")
                .expect("the template uses only keys of indicatif");
            let line = ProgressBar::new_spinner().with_style(style).with_message(text).with_elapsed(LONG);
            while done.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                line.tick();
            }
            line.finish_and_clear();
        });
        // The thread ends when this is dropped, also where the action panics.
        let _sender = sender;
        action()
    })
}
