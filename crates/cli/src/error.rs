//! Errors of the shell and their exit codes.

use std::io;

use clap::error::ErrorKind;
use teeter_dissertation::jenga3d::{self, ConstantError, IniError};
use teeter_game::{RecordError, RulesError};
use teeter_physics::BuildError;
use teeter_render::FilmError;
use teeter_report::score::LabelledError;
use teeter_report::validation::{DataSheetError, RealRowsError};
use teeter_scene::{NAMED, SceneError, printable};
use teeter_study::FieldError;

use crate::message::message as print;

/// Exit code for help and the like.
const SUCCESS: u8 = 0;
/// Exit code for bad input.
const BAD_INPUT: u8 = 2;
/// Exit code for a replay that diverges.
const DIVERGED: u8 = 1;

/// Error that ends a command.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Command line that is not valid, or asks for help.
    #[error(transparent)]
    Usage(#[from] clap::Error),
    /// Standard output whose reader has left.
    #[error("standard output is closed")]
    StdoutClosed,
    /// Standard output that cannot be written.
    #[error("standard output cannot be written: {0}")]
    Stdout(io::Error),
    /// Standard error that cannot be written, where it has the report.
    #[error("standard error cannot be written: {0}")]
    Stderr(io::Error),
    /// Input that cannot be read.
    #[error("{name}: {source}")]
    Input {
        /// Name of the file or stream.
        name: String,
        /// Cause.
        source: InputError,
    },
    /// Name of no scene and no file.
    #[error("there is no scene `{name}`, neither a file nor one of {}", names())]
    UnknownScene {
        /// Name.
        name: String,
    },
    /// Options of a scene that contradict each other.
    #[error(transparent)]
    SceneOptions(#[from] SceneError),
    /// Scene whose blocks cannot be pushed apart, or that is not valid.
    #[error("{name}: {source}")]
    Settle {
        /// Name of the file or stream.
        name: String,
        /// Cause.
        source: SceneError,
    },
    /// Scene that cannot be simulated.
    #[error("{name}: {source}")]
    Build {
        /// Name of the scene.
        name: String,
        /// Cause.
        source: BuildError,
    },
    /// Scene that the simulator of 2003 cannot build, or constants with which it cannot run.
    #[error("{name}: {source}")]
    Dissertation {
        /// Name of the scene.
        name: String,
        /// Cause.
        source: jenga3d::BuildError,
    },
    /// File of constants that is not valid.
    #[error("{name}, {source}")]
    Ini {
        /// Name of the file or stream.
        name: String,
        /// Cause.
        source: IniError,
    },
    /// Constant of an option that is unknown or out of its range.
    #[error(transparent)]
    Constant(#[from] ConstantError),
    /// Option that sets no constant.
    #[error("--set {text}: expected NAME=VALUE, such as stiffness=2e4")]
    Assignment {
        /// Text of the option.
        text: String,
    },
    /// Rows for a scene other than the tower.
    #[error("--rows is that of the scene `tower`, and the scene is {name}")]
    RowsOfScene {
        /// Name of the scene.
        name: String,
    },
    /// Standard input for a scene and for constants.
    #[error("standard input cannot be both the scene and the constants: give the file of one of them")]
    StdinTwiceIni,
    /// Line of a file of inputs that is not a change.
    #[error("{name}, line {line}: {source}")]
    Inputs {
        /// Name of the file or stream.
        name: String,
        /// Line, from 1.
        line: usize,
        /// Cause.
        source: FieldError,
    },
    /// File of inputs without a line.
    #[error("{name}: no inputs, expected one JSON object a line")]
    NoInputs {
        /// Name of the file or stream.
        name: String,
    },
    /// Line of a file of commands that is none.
    #[error("{name}, line {line}: {message}")]
    Command {
        /// Name of the file or stream.
        name: String,
        /// Line, from 1.
        line: usize,
        /// Cause.
        message: String,
    },
    /// Rules that no game has.
    #[error(transparent)]
    Rules(#[from] RulesError),
    /// Record that cannot be read or replayed, or scene that no game begins on.
    #[error("{name}: {source}")]
    Record {
        /// Name of the file, the stream or the scene.
        name: String,
        /// Cause.
        source: RecordError,
    },
    /// Replay that is not that of its record, which is printed besides.
    #[error("the replay diverges from its record")]
    Diverged,
    /// Standard input for a scene and for commands.
    #[error("standard input cannot be both the scene and the commands: give the file of one of them")]
    StdinTwiceCommands,
    /// Trace in no known format.
    #[error("{name}: a trace is a file that ends with .parquet, .csv or .jsonl")]
    TraceFormat {
        /// Name of the file.
        name: String,
    },
    /// Picture or film in no known format.
    #[error("{name}: a picture is a file that ends with .png, a film one with .gif or .mp4")]
    PictureFormat {
        /// Name of the file.
        name: String,
    },
    /// Options of a simulation beside a record.
    #[error("{name} is a record, which has its own inputs, stiffness, friction and form: leave those options out")]
    RecordOptions {
        /// Name of the file.
        name: String,
    },
    /// Duration or frame rate of a picture.
    #[error("{name} is one picture: --seconds and --fps are for films, which end with .gif or .mp4")]
    FilmOptions {
        /// Name of the file.
        name: String,
    },
    /// Picture or film that cannot be written.
    #[error("{name}: {source}")]
    Film {
        /// Name of the file.
        name: String,
        /// Cause.
        source: FilmError,
    },
    /// Standard input for two files.
    #[error("standard input cannot be both the scene and the inputs: give the file of one of them")]
    StdinTwice,
    /// Tournament without a pair.
    #[error("--players names one opponent: a tournament needs two opponents, such as random,expert")]
    OneOpponent,
    /// Labelled towers that cannot be read.
    #[error(transparent)]
    Labelled(#[from] LabelledError),
    /// Output file that cannot be created.
    #[error("{name}: cannot be written: {}", obstacle(source))]
    Create {
        /// Name of the file.
        name: String,
        /// Cause.
        source: io::Error,
    },
    /// Output file that cannot be written to its end.
    #[error("{name}: {source}")]
    Write {
        /// Name of the file.
        name: String,
        /// Cause.
        source: io::Error,
    },
    /// Report that cannot be measured or written.
    #[error(transparent)]
    Report(#[from] teeter_report::Error),
    /// Program without the page.
    #[cfg(not(feature = "page"))]
    #[error("this program was built without the page: `make play` builds it with the page and starts it")]
    NoPage,
    /// Server that cannot be started.
    #[cfg(feature = "page")]
    #[error("the server cannot start: {0}")]
    Start(io::Error),
    /// Machine that is in no network.
    #[cfg(feature = "page")]
    #[error("this machine is in no network, so --lan shows the page to nobody: {0}")]
    NoNetwork(io::Error),
    /// Port that is in use.
    #[cfg(feature = "page")]
    #[error("port {0} is taken: choose another with --port, or leave --port out for a free one")]
    PortTaken(u16),
    /// Port that only a privileged user may open.
    #[cfg(feature = "page")]
    #[error("port {0} may not be used: choose one above 1023 with --port")]
    PortDenied(u16),
    /// Port that cannot be opened for another reason.
    #[cfg(feature = "page")]
    #[error("port {port} cannot be used: {source}")]
    Port {
        /// Port.
        port: u16,
        /// Cause.
        source: io::Error,
    },
    /// Machine without a free port.
    #[cfg(feature = "page")]
    #[error("no port can be used: {0}")]
    NoPort(io::Error),
}

/// Cause of an input that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// Path of no file.
    #[error("there is no such file")]
    Missing,
    /// File without permission.
    #[error("this file may not be read")]
    Denied,
    /// Path of a folder.
    #[error("this is a folder, expected a file")]
    Folder,
    /// Failure of the system.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// Scene that is not valid, or too large.
    #[error("{}{}", .0, remedy(.0))]
    Scene(#[from] SceneError),
    /// File that is larger than is read.
    #[error("larger than {} MB, the most that is read", .0 / 1_000_000)]
    TooLarge(u64),
    /// File that is not text, with the index of the first byte that is not.
    #[error("this is not text: byte {0} is neither UTF-8 nor UTF-16")]
    NotText(usize),
    /// Data sheet that is not valid.
    #[error(transparent)]
    DataSheet(#[from] DataSheetError),
    /// Tables of a real set that are not valid.
    #[error(transparent)]
    RealRows(#[from] RealRowsError),
}

impl Error {
    /// Error of an input.
    pub fn input(name: &str, source: impl Into<InputError>) -> Self {
        Self::Input { name: name.to_owned(), source: source.into() }
    }

    /// Writes the error to standard error as one line, except for help, and returns the exit code.
    pub fn report(&self) -> u8 {
        match self {
            // `teeter scene tower | head` is no error: the reader has what it needs.
            Self::StdoutClosed => SUCCESS,
            Self::Usage(error) => report_usage(error),
            Self::Diverged => DIVERGED,
            error => report_line(&error.to_string()),
        }
    }
}

/// Cause of a file that cannot be created.
fn obstacle(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => "there is no such folder".to_owned(),
        io::ErrorKind::IsADirectory => "this is a folder, expected a file".to_owned(),
        io::ErrorKind::PermissionDenied => "it may not be written".to_owned(),
        _ => error.to_string(),
    }
}

/// Means against an error of a scene that no editing of numbers cures.
fn remedy(error: &SceneError) -> &'static str {
    match error {
        SceneError::Overlap { .. } => "; `teeter run --settle` pushes blocks apart",
        _ => "",
    }
}

/// Names of the scenes of the list.
fn names() -> String {
    NAMED.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ")
}

fn report_line(message: &str) -> u8 {
    // Names of files and scenes can contain any character, also line breaks.
    print(&format!("teeter: {}", printable(message)));
    BAD_INPUT
}

fn report_usage(error: &clap::Error) -> u8 {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            let _ = error.print();
            SUCCESS
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = error.print();
            BAD_INPUT
        }
        _ => {
            // The first paragraph of clap names the error, the others are help.
            let text = error.to_string();
            let first = text.split("\n\n").next().unwrap_or_default();
            let words: Vec<&str> = first.trim_start_matches("error: ").split_whitespace().collect();
            report_line(&format!("{}; see `teeter --help` and `teeter COMMAND --help`", words.join(" ")))
        }
    }
}
