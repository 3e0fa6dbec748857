//! Output file that appears whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// Output file that appears whole or not at all: it is written beside its path under another name,
/// and renamed by [`OutFile::finish`]. Dropped before, it leaves what was at the path.
///
/// A file that exists is replaced and keeps its permissions; a link to it stays a link. A device or
/// a pipe is written directly.
///
/// ```
/// use std::io::Write;
/// use teeter_report::OutFile;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("figures.txt");
/// let mut file = OutFile::create(&path)?;
/// file.write_all(b"42\n")?;
/// assert!(!path.exists());
/// file.finish()?;
/// assert_eq!(std::fs::read(&path)?, b"42\n");
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct OutFile(Sink);

/// Files that are not finished. A program that is interrupted removes them, see
/// [`OutFile::abandon_all`].
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Entry of a file in [`UNFINISHED`], for as long as this lives.
#[derive(Debug)]
struct Unfinished(PathBuf);

impl Drop for Unfinished {
    fn drop(&mut self) {
        unfinished().retain(|path| *path != self.0);
    }
}

/// The list stays valid where a thread has panicked.
fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

#[derive(Debug)]
enum Sink {
    /// File beside the path, its entry, and the path.
    Beside(BufWriter<NamedTempFile>, Unfinished, PathBuf),
    /// Device or pipe, which cannot be renamed.
    Direct(BufWriter<File>),
}

impl OutFile {
    /// Creates the file under another name.
    ///
    /// # Errors
    /// When the path is a folder, may not be written, or its folder is missing or may not be
    /// written.
    pub fn create(path: &Path) -> io::Result<Self> {
        // A link is followed, or the rename would replace it.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let mut builder = tempfile::Builder::new();
        match fs::metadata(&target) {
            Ok(metadata) => {
                // A file without permission to write could still be replaced by a rename.
                let file = OpenOptions::new().write(true).open(&target)?;
                if !metadata.is_file() {
                    return Ok(Self(Sink::Direct(BufWriter::new(file))));
                }
                builder.permissions(metadata.permissions());
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => allow_umask(&mut builder),
            Err(error) => return Err(error),
        }
        let folder = match target.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let name = target.file_name().ok_or(io::ErrorKind::IsADirectory)?;
        let mut prefix = std::ffi::OsString::from(".");
        prefix.push(name);
        prefix.push(".");
        // No file appears once all are abandoned.
        let mut unfinished = unfinished();
        let beside = builder.prefix(&prefix).suffix(".tmp").tempfile_in(folder);
        // The name beside means nothing to a user, and the error would contain it.
        let beside = beside.map_err(|error| io::Error::from(error.kind()))?;
        let path = beside.path().to_owned();
        unfinished.push(path.clone());
        Ok(Self(Sink::Beside(BufWriter::new(beside), Unfinished(path), target)))
    }

    /// Removes all files that are not finished: for a program that is about to end because it was
    /// interrupted. A file that is about to be created or finished waits for as long as the result
    /// lives.
    pub fn abandon_all() -> impl Sized {
        let unfinished = unfinished();
        for path in unfinished.iter() {
            // What is gone already needs no removal.
            let _ = fs::remove_file(path);
        }
        unfinished
    }

    /// Writes what is buffered, and gives the file its name.
    ///
    /// # Errors
    /// When the rest cannot be written, or the file cannot be renamed.
    pub fn finish(self) -> io::Result<()> {
        match self.0 {
            Sink::Direct(mut file) => file.flush(),
            Sink::Beside(file, entry, target) => {
                let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                // After a power failure the new name must not lead to a file without its content.
                file.as_file().sync_all()?;
                let unfinished = unfinished();
                let done = file.persist(target).map(drop).map_err(|error| error.error);
                drop(unfinished);
                drop(entry);
                done
            }
        }
    }
}

impl Write for OutFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.0 {
            Sink::Beside(file, ..) => file.write(bytes),
            Sink::Direct(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.0 {
            Sink::Beside(file, ..) => file.flush(),
            Sink::Direct(file) => file.flush(),
        }
    }
}

/// Gives a new file the permissions of any other: a temporary one would be for its owner alone.
#[cfg(unix)]
fn allow_umask(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn allow_umask(_: &mut tempfile::Builder<'_, '_>) {}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_dropped_file_leaves_the_old_one_and_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "old").unwrap();
        let mut file = OutFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        drop(file);
        assert_eq!((fs::read(&path).unwrap().as_slice(), names(folder.path())), (&b"old"[..], vec!["a".to_owned()]));
    }

    #[test]
    fn a_finished_file_replaces_the_old_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "a longer old text").unwrap();
        let mut file = OutFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"a longer old text");
        file.finish().unwrap();
        assert_eq!((fs::read(&path).unwrap().as_slice(), names(folder.path())), (&b"new"[..], vec!["a".to_owned()]));
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("a"), folder.path().join("link"));
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        let mut file = OutFile::create(&link).unwrap();
        file.write_all(b"new").unwrap();
        file.finish().unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        let plain = folder.path().join("plain");
        fs::write(&plain, "").unwrap();
        let fresh = folder.path().join("fresh");
        OutFile::create(&fresh).unwrap().finish().unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&fresh), mode(&plain));
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_and_not_replaced() {
        use std::os::unix::fs::FileTypeExt;
        let mut file = OutFile::create(Path::new("/dev/null")).unwrap();
        file.write_all(b"new").unwrap();
        file.finish().unwrap();
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    }

    #[test]
    fn a_folder_and_a_missing_folder_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        OutFile::create(folder.path()).unwrap_err();
        let error = OutFile::create(&folder.path().join("none/a")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(names(folder.path()).is_empty());
    }
}
