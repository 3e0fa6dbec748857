//! Threads: work without Python's lock, and pools that survive a fork.
//!
//! A child that was forked has none of its parent's threads, and would wait for rayon's pool for
//! ever. So work of a child runs in a pool of its own.

use std::mem::ManuallyDrop;
use std::process;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::Kind;

/// Process that imported the module.
static IMPORTER: OnceLock<u32> = OnceLock::new();
/// Pool of a forked child.
static FORKED: Pool = Pool::new(0);

/// Notes the process that imports the module.
pub fn note_process() {
    IMPORTER.get_or_init(process::id);
}

/// Runs work without Python's lock, so that other threads of Python go on.
pub fn detached<R: Send>(py: Python<'_>, work: impl FnOnce() -> R + Send) -> PyResult<R> {
    if IMPORTER.get() == Some(&process::id()) {
        return Ok(py.detach(work));
    }
    FORKED.run(py, work)
}

/// Pool of threads, built when it is needed first in a process.
#[derive(Debug)]
pub struct Pool {
    /// Number of threads; 0 for one a core.
    threads: usize,
    built: Mutex<Option<(u32, Arc<ThreadPool>)>>,
}

impl Pool {
    /// A pool of `threads` threads, 0 for one a core.
    pub const fn new(threads: usize) -> Self {
        Self { threads, built: Mutex::new(None) }
    }

    /// Runs work in the pool, without Python's lock.
    pub fn run<R: Send>(&self, py: Python<'_>, work: impl FnOnce() -> R + Send) -> PyResult<R> {
        let pool = self.pool()?;
        Ok(py.detach(|| pool.install(work)))
    }

    /// Number of threads.
    pub fn threads(&self) -> PyResult<usize> {
        Ok(self.pool()?.current_num_threads())
    }

    fn pool(&self) -> PyResult<Arc<ThreadPool>> {
        let mut built = self.built.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pool)) = built.as_ref().filter(|(process, _)| *process == process::id()) {
            return Ok(pool.clone());
        }
        let pool = ThreadPoolBuilder::new().num_threads(self.threads).build();
        let pool = Arc::new(pool.map_err(|error| Kind::Input.error(format_args!("`threads`: {error}")))?);
        // A parent's pool must not be dropped in a child: its threads are not there to end.
        let _undropped = ManuallyDrop::new(built.replace((process::id(), pool.clone())));
        Ok(pool)
    }
}
