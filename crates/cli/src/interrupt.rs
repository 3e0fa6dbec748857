//! End of a command that is interrupted: no file is left half-written.

use teeter_report::OutFile;

/// Ends the program at SIGINT or SIGTERM with the exit code that shells give, 128 and the number of
/// the signal, after the removal of unfinished files.
#[cfg(unix)]
#[allow(clippy::disallowed_methods, reason = "the thread waits for signals and reads nothing of the physics")]
pub fn watch() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    // Without a handler the signals end the program as well, but leave its files.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            let _abandoned = OutFile::abandon_all();
            std::process::exit(128 + signal);
        }
    });
}

/// Leaves Ctrl-C to the system.
#[cfg(not(unix))]
pub fn watch() {}
