//! Connections of the server: a limited number, of which those without progress make room for new
//! ones.

use std::io;
use std::pin::Pin;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::AbortHandle;
use tokio::time::Instant;

/// Maximum number of connections; the page needs six.
const MAX_CONNECTIONS: usize = 512;
/// Time without a byte in either direction after which a connection is closed.
const MAX_PAUSE: Duration = Duration::from_secs(30);
/// Time for the head of a request to arrive.
const MAX_HEAD_TIME: Duration = Duration::from_secs(10);
/// Pause after a connection could not be accepted.
const RETRY: Duration = Duration::from_millis(5);

/// Connections that are being served.
struct Connections {
    start: Instant,
    open: Mutex<Vec<Connection>>,
}

/// Connection that is being served.
struct Connection {
    id: u64,
    progress: Arc<AtomicU64>,
    task: AbortHandle,
}

/// Serves connections for ever.
pub async fn serve(listener: TcpListener, router: Router) {
    let connections = Arc::new(Connections { start: Instant::now(), open: Mutex::new(Vec::new()) });
    tokio::spawn(close_paused(Arc::clone(&connections)));
    for id in 0.. {
        let stream = loop {
            match listener.accept().await {
                Ok((stream, _)) => break stream,
                // Mostly there are too many open files.
                Err(_) => {
                    connections.make_room();
                    tokio::time::sleep(RETRY).await;
                }
            }
        };
        if connections.open().len() >= MAX_CONNECTIONS {
            connections.make_room();
        }
        connections.spawn(id, stream, router.clone());
    }
}

async fn close_paused(connections: Arc<Connections>) {
    let mut every_second = tokio::time::interval(Duration::from_secs(1));
    loop {
        every_second.tick().await;
        connections.close_paused();
    }
}

impl Connections {
    fn open(&self) -> MutexGuard<'_, Vec<Connection>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Time since the start, ms.
    fn now(&self) -> u64 {
        self.start.elapsed().as_millis() as u64
    }

    /// Closes the connection that has been without progress for the longest time.
    fn make_room(&self) {
        let mut open = self.open();
        let longest = (0..open.len()).min_by_key(|&i| open[i].progress.load(Relaxed));
        if let Some(longest) = longest {
            open.remove(longest).task.abort();
        }
    }

    /// Closes all connections that have been without progress for [`MAX_PAUSE`].
    fn close_paused(&self) {
        let limit = self.now().saturating_sub(MAX_PAUSE.as_millis() as u64);
        self.open().retain(|connection| {
            let is_active = connection.progress.load(Relaxed) >= limit;
            if !is_active {
                connection.task.abort();
            }
            is_active
        });
    }

    /// Serves a connection in a task of its own.
    fn spawn(self: &Arc<Self>, id: u64, stream: TcpStream, router: Router) {
        let progress = Arc::new(AtomicU64::new(self.now()));
        // Small responses go out at once.
        let _ = stream.set_nodelay(true);
        let watched = Watched { stream, progress: Arc::clone(&progress), connections: Arc::clone(self) };
        let connections = Arc::clone(self);
        // The task removes its entry, which must be there before.
        let mut open = self.open();
        let task = tokio::spawn(async move {
            let served = http1::Builder::new()
                .timer(TokioTimer::new())
                .header_read_timeout(MAX_HEAD_TIME)
                .serve_connection(TokioIo::new(watched), TowerToHyperService::new(router));
            // A client that leaves, or sends what is no request, is no error of the server.
            let _ = served.await;
            connections.open().retain(|connection| connection.id != id);
        });
        open.push(Connection { id, progress, task: task.abort_handle() });
    }
}

/// Stream that records the time of the last byte.
struct Watched {
    stream: TcpStream,
    progress: Arc<AtomicU64>,
    connections: Arc<Connections>,
}

impl Watched {
    fn record(&self, count: usize) {
        if count > 0 {
            self.progress.store(self.connections.now(), Relaxed);
        }
    }
}

impl AsyncRead for Watched {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context, buffer: &mut ReadBuf) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        let polled = Pin::new(&mut self.stream).poll_read(context, buffer);
        self.record(buffer.filled().len() - before);
        polled
    }
}

impl AsyncWrite for Watched {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let polled = Pin::new(&mut self.stream).poll_write(context, bytes);
        if let Poll::Ready(Ok(count)) = polled {
            self.record(count);
        }
        polled
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context,
        parts: &[io::IoSlice],
    ) -> Poll<io::Result<usize>> {
        let polled = Pin::new(&mut self.stream).poll_write_vectored(context, parts);
        if let Poll::Ready(Ok(count)) = polled {
            self.record(count);
        }
        polled
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
