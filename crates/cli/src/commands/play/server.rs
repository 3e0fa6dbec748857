//! Server that runs until interrupted, for this machine or for its network.

use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::ops::RangeInclusive;

use axum::Router;
use axum::middleware::from_fn;
use axum::routing::get;
use tokio::net::{TcpListener, TcpSocket};

use super::host::{self, Audience};
use super::{connections, network, page};
use crate::error::Error;
use crate::output;

/// Ports that are tried in turn where none is named.
const PORTS: RangeInclusive<u16> = 8080..=8099;
/// Bytes that the system takes for a reader before it has read any: few, or readers that do not
/// read keep the server busy.
const SEND_BUFFER: u32 = 64 * 1024;
/// Maximum number of connections that wait to be accepted.
const MAX_WAITING: u32 = 1024;

/// Serves the page until interrupted.
pub fn serve(port: Option<u16>, audience: Audience, open_browser: bool) -> Result<(), Error> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(Error::Start)?;
    runtime.block_on(async {
        let (interface, number) = match audience {
            Audience::Loopback => (Ipv4Addr::LOCALHOST, IpAddr::V4(Ipv4Addr::LOCALHOST)),
            Audience::Network => (Ipv4Addr::UNSPECIFIED, network::address().map_err(Error::NoNetwork)?),
        };
        page::prepare();
        let listener = listen(interface, port)?;
        // Before the address is printed: its reader may interrupt the program at once.
        let interrupted = interrupted().map_err(Error::Start)?;
        let port = listener.local_addr().map_err(Error::Start)?.port();
        print_address(&format!("http://{number}:{port}/"), audience)?;
        let own = format!("http://{}:{port}/", Ipv4Addr::LOCALHOST);
        if open_browser && open::that_detached(own).is_err() {
            output::line("No browser could be opened: open the address above in one.")?;
        }
        let page = get(page::file);
        let router = Router::new().route("/", page.clone()).fallback(page);
        let router = router.layer(from_fn(move |request, next| host::check(audience, request, next)));
        tokio::select! {
            () = connections::serve(listener, router) => Ok(()),
            () = interrupted => Ok(()),
        }
    })
}

fn print_address(address: &str, audience: Audience) -> Result<(), Error> {
    output::line(&format!("Teeter is at {address} (Ctrl-C ends it)"))?;
    if audience == Audience::Loopback {
        return Ok(());
    }
    output::line(network::WARNING)?;
    network::qr_code(address).map_or(Ok(()), |code| output::line(&code))
}

fn listen(interface: Ipv4Addr, port: Option<u16>) -> Result<TcpListener, Error> {
    let bind = |port| bind(SocketAddr::from((interface, port)));
    if let Some(port) = port {
        return bind(port).map_err(|source| match source.kind() {
            io::ErrorKind::AddrInUse => Error::PortTaken(port),
            io::ErrorKind::PermissionDenied => Error::PortDenied(port),
            _ => Error::Port { port, source },
        });
    }
    for port in PORTS {
        if let Ok(listener) = bind(port) {
            return Ok(listener);
        }
    }
    bind(0).map_err(Error::NoPort)
}

fn bind(address: SocketAddr) -> io::Result<TcpListener> {
    let socket = TcpSocket::new_v4()?;
    // A server that is started again need not wait for the connections of the last one. Windows
    // means something else by this.
    #[cfg(unix)]
    socket.set_reuseaddr(true)?;
    socket.set_send_buffer_size(SEND_BUFFER)?;
    socket.bind(address)?;
    socket.listen(MAX_WAITING)
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
