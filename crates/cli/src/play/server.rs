//! A server on 127.0.0.1 that ends when it is interrupted.

use std::io;
use std::net::Ipv4Addr;

use axum::Router;
use axum::routing::get;
use tokio::net::TcpListener;

use super::page;
use crate::fault::Fault;
use crate::output;

/// The port that is tried first where none was asked for.
const USUAL_PORT: u16 = 8080;

/// Serves the page until interrupted.
pub fn serve(port: Option<u16>, open_browser: bool) -> Result<(), Fault> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|e| Fault::at("the server cannot start", e))?;
    runtime.block_on(async {
        let listener = listen(port).await?;
        // Whoever reads the address may ask for the end at once: it must be heard from then on.
        let interrupted = interrupted().map_err(|e| Fault::at("the server cannot start", e))?;
        let address = listener.local_addr().map_err(|e| Fault::at("the server cannot start", e))?;
        let address = format!("http://{address}/");
        output::line(&format!("Teeter is at {address} (Ctrl-C ends it)"))?;
        if open_browser && open::that_detached(&address).is_err() {
            output::line("No browser could be opened: open the address above in one.")?;
        }
        let router = Router::new().route("/", get(page::file)).fallback(get(page::file));
        tokio::select! {
            ended = axum::serve(listener, router) => ended.map_err(|e| Fault::at("the server ended", e)),
            () = interrupted => Ok(()),
        }
    })
}

async fn listen(port: Option<u16>) -> Result<TcpListener, Fault> {
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match port {
        Some(port) => bind(port).await.map_err(|e| match e.kind() {
            io::ErrorKind::AddrInUse => Fault::Said(format!(
                "port {port} is taken: choose another with --port, or leave --port out for a free one"
            )),
            io::ErrorKind::PermissionDenied => {
                Fault::Said(format!("port {port} may not be used: choose one above 1023 with --port"))
            }
            _ => Fault::Said(format!("port {port} cannot be used: {e}")),
        }),
        None => match bind(USUAL_PORT).await {
            Ok(listener) => Ok(listener),
            Err(_) => bind(0).await.map_err(|e| Fault::Said(format!("no port can be used: {e}"))),
        },
    }
}

/// Listens from now on for being asked to end, by Ctrl-C or by whoever started the program; the future is over when that came.
#[cfg(unix)]
fn interrupted() -> io::Result<impl Future<Output = ()>> {
    use tokio::signal::unix::{SignalKind, signal};
    let mut from_keyboard = signal(SignalKind::interrupt())?;
    let mut from_starter = signal(SignalKind::terminate())?;
    Ok(async move {
        tokio::select! {
            _ = from_keyboard.recv() => {}
            _ = from_starter.recv() => {}
        }
    })
}

/// Listens from now on for Ctrl-C; the future is over when it came.
#[cfg(windows)]
fn interrupted() -> io::Result<impl Future<Output = ()>> {
    let mut from_keyboard = tokio::signal::windows::ctrl_c()?;
    Ok(async move {
        from_keyboard.recv().await;
    })
}
