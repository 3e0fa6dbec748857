//! `teeter dissertation`: the chapter of results of the 2003 dissertation, run again.

use crate::args::{Dissertation, DissertationCommand};
use crate::fault::Fault;
use crate::output;

/// Runs one of its commands.
pub fn main(args: Dissertation) -> Result<(), Fault> {
    match args.command {
        DissertationCommand::Report(args) => {
            let path = teeter_report::dissertation::write(&args.out, &args.only)?;
            output::line(&format!("{}", path.display()))
        }
    }
}
