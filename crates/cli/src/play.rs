//! `teeter play`: the page, served on this machine alone.

use crate::args::Play;
use crate::fault::Fault;

/// Serves the page until interrupted.
#[cfg(feature = "page")]
pub fn main(args: Play) -> Result<(), Fault> {
    server::serve(args.port, !args.no_open)
}

/// Says how to get a program that has the page.
#[cfg(not(feature = "page"))]
pub fn main(args: Play) -> Result<(), Fault> {
    let _ = (args.port, args.no_open);
    Err("this program was built without the page: `make play` builds it with the page and starts it".into())
}

#[cfg(feature = "page")]
mod page;
#[cfg(feature = "page")]
mod server;
