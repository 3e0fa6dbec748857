//! `teeter dissertation`: the chapter of results of the 2003 dissertation, run again.

mod column;
mod disabled;
mod flat;
mod frame_rate;
mod moves;
mod page;
mod picture;
mod report;
mod requirements;
mod soft;
mod statics;
mod table_5_2;
mod work;

use crate::args::{Dissertation, DissertationCommand};
use crate::fault::Fault;

/// Runs one of its commands.
pub fn main(args: Dissertation) -> Result<(), Fault> {
    match args.command {
        DissertationCommand::Report(args) => report::main(&args),
    }
}

/// Names of the parts of the report, for `--only`.
pub fn part_names() -> Vec<&'static str> {
    report::PARTS.iter().map(|part| part.name).collect()
}
