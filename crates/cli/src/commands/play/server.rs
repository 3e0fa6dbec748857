//! Server on 127.0.0.1 that runs until interrupted.

use std::io;
use std::net::Ipv4Addr;

use axum::Router;
use axum::routing::get;
use tokio::net::TcpListener;

use super::page;
use crate::error::Error;
use crate::output;

/// Port that is tried first where none is named.
const DEFAULT_PORT: u16 = 8080;

/// Serves the page until interrupted.
pub fn serve(port: Option<u16>, open_browser: bool) -> Result<(), Error> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(Error::Start)?;
    runtime.block_on(async {
        let listener = listen(port).await?;
        // Before the address is printed: its reader may interrupt the program at once.
        let interrupted = interrupted().map_err(Error::Start)?;
        let address = listener.local_addr().map_err(Error::Start)?;
        let address = format!("http://{address}/");
        output::line(&format!("Teeter is at {address} (Ctrl-C ends it)"))?;
        if open_browser && open::that_detached(&address).is_err() {
            output::line("No browser could be opened: open the address above in one.")?;
        }
        let router = Router::new().route("/", get(page::file)).fallback(get(page::file));
        tokio::select! {
            ended = axum::serve(listener, router) => ended.map_err(Error::Serve),
            () = interrupted => Ok(()),
        }
    })
}

async fn listen(port: Option<u16>) -> Result<TcpListener, Error> {
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match port {
        Some(port) => bind(port).await.map_err(|source| match source.kind() {
            io::ErrorKind::AddrInUse => Error::PortTaken(port),
            io::ErrorKind::PermissionDenied => Error::PortDenied(port),
            _ => Error::Port { port, source },
        }),
        None => match bind(DEFAULT_PORT).await {
            Ok(listener) => Ok(listener),
            Err(_) => bind(0).await.map_err(Error::NoPort),
        },
    }
}

/// Starts to listen for Ctrl-C and SIGTERM; the future ends with the first of them.
#[cfg(unix)]
fn interrupted() -> io::Result<impl Future<Output = ()>> {
    use tokio::signal::unix::{SignalKind, signal};
    let mut interrupt = signal(SignalKind::interrupt())?;
    let mut terminate = signal(SignalKind::terminate())?;
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
    })
}

/// Starts to listen for Ctrl-C; the future ends with it.
#[cfg(windows)]
fn interrupted() -> io::Result<impl Future<Output = ()>> {
    let mut interrupt = tokio::signal::windows::ctrl_c()?;
    Ok(async move {
        interrupt.recv().await;
    })
}
