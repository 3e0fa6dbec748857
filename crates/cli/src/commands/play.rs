//! `teeter play`: serves the page on this machine, or in its network.

#[cfg(feature = "page")]
mod connections;
#[cfg(feature = "page")]
mod host;
#[cfg(feature = "page")]
mod network;
#[cfg(feature = "page")]
mod page;
#[cfg(feature = "page")]
mod server;

use clap::Args;

use crate::error::Error;

/// Arguments of `teeter play`.
#[derive(Debug, Args)]
pub struct Play {
    /// Port, 0 for any free one [default: 8080, or the next one that is free].
    #[arg(long)]
    port: Option<u16>,
    /// Serve the page to other devices in this network as well, and show its address as a QR code.
    #[arg(long)]
    lan: bool,
    /// Do not open a browser.
    #[arg(long)]
    no_open: bool,
}

impl Play {
    /// Serves the page until interrupted.
    #[cfg(feature = "page")]
    pub fn run(self) -> Result<(), Error> {
        let audience = if self.lan { host::Audience::Network } else { host::Audience::Loopback };
        server::serve(self.port, audience, !self.no_open)
    }

    /// Reports that the program has no page.
    #[cfg(not(feature = "page"))]
    pub fn run(self) -> Result<(), Error> {
        let Self { port: _, lan: _, no_open: _ } = self;
        Err(Error::NoPage)
    }
}
