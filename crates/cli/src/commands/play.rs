//! `teeter play`: serves the page on this machine alone.

#[cfg(feature = "page")]
mod page;
#[cfg(feature = "page")]
mod server;

use clap::Args;

use crate::error::Error;

/// Arguments of `teeter play`.
#[derive(Debug, Args)]
pub struct Play {
    /// Port on 127.0.0.1, 0 for any free one [default: 8080, or a free one where that is taken].
    #[arg(long)]
    port: Option<u16>,
    /// Do not open a browser.
    #[arg(long)]
    no_open: bool,
}

impl Play {
    /// Serves the page until interrupted.
    #[cfg(feature = "page")]
    pub fn run(self) -> Result<(), Error> {
        server::serve(self.port, !self.no_open)
    }

    /// Reports that the program has no page.
    #[cfg(not(feature = "page"))]
    pub fn run(self) -> Result<(), Error> {
        let Self { port: _, no_open: _ } = self;
        Err(Error::NoPage)
    }
}
