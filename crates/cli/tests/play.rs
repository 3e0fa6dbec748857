//! `teeter play`: the page comes whole from 127.0.0.1, each file with its type and its headers, to
//! whoever asks however many do, and Ctrl-C ends it quietly.

mod common;

#[cfg(not(feature = "page"))]
#[test]
fn without_the_page_it_says_how_to_get_it() {
    let done = common::teeter(&["play", "--no-open"]);
    assert_eq!(
        done.error_line(),
        "this program was built without the page: `make play` builds it with the page and starts it"
    );
}

#[cfg(feature = "page")]
mod served {
    use std::io::{BufRead, BufReader, Read, Write};
    use std::net::{TcpListener, TcpStream};
    use std::path::Path;
    use std::process::{Child, Command};

    use super::common;

    struct Server {
        child: Child,
        address: String,
    }

    impl Server {
        fn start(args: &[&str]) -> Self {
            Self::of(common::command(&[&["play", "--no-open"], args].concat()))
        }

        /// Server of a command that starts it.
        fn of(mut command: Command) -> Self {
            let mut child = command.spawn().unwrap();
            let mut line = String::new();
            BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
            let address =
                line.strip_prefix("Teeter is at http://").and_then(|l| l.strip_suffix("/ (Ctrl-C ends it)\n"));
            let address = address.unwrap_or_else(|| panic!("{line:?}")).to_owned();
            Self { child, address }
        }

        /// Status line, headers in lower case, and body.
        fn get(&self, method: &str, path: &str) -> (String, Vec<String>, Vec<u8>) {
            self.ask(method, path, &format!("Host: {}\r\n", self.address))
        }

        /// As [`Server::get`], with these headers.
        fn ask(&self, method: &str, path: &str, headers: &str) -> (String, Vec<String>, Vec<u8>) {
            let mut stream = TcpStream::connect(&self.address).unwrap();
            write!(stream, "{method} {path} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n").unwrap();
            let mut bytes = Vec::new();
            stream.read_to_end(&mut bytes).unwrap();
            let end = bytes.windows(4).position(|w| w == b"\r\n\r\n").unwrap();
            let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
            let mut lines = head.split("\r\n").map(str::to_lowercase);
            (lines.next().unwrap(), lines.collect(), bytes[end + 4..].to_vec())
        }
    }

    impl Drop for Server {
        fn drop(&mut self) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }

    fn built_files(folder: &Path, into: &mut Vec<std::path::PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension() {
                _ if path.is_dir() => built_files(&path, into),
                // Another form of a file, not a file of its own.
                Some(ending) if ending == "br" => {}
                _ => into.push(path),
            }
        }
    }

    #[test]
    fn every_file_of_the_page() {
        let server = Server::start(&["--port", "0"]);
        assert!(server.address.starts_with("127.0.0.1:"));
        let dist = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/dist");
        let mut files = Vec::new();
        built_files(&dist, &mut files);
        let mut kinds = Vec::new();
        for file in &files {
            let path = format!("/{}", file.strip_prefix(&dist).unwrap().to_str().unwrap());
            let (status, headers, body) = server.get("GET", &path);
            assert_eq!((status.as_str(), body == std::fs::read(file).unwrap()), ("http/1.1 200 ok", true), "{path}");
            let kind = match file.extension().and_then(|e| e.to_str()) {
                Some("html") => "text/html; charset=utf-8",
                Some("js") => "text/javascript; charset=utf-8",
                Some("css") => "text/css; charset=utf-8",
                Some("wasm") => "application/wasm",
                Some("webmanifest") => "application/manifest+json",
                Some("webp") => "image/webp",
                _ => continue,
            };
            kinds.push(kind);
            assert!(headers.contains(&format!("content-type: {kind}")), "{path}: {headers:?}");
            let cache = if path.starts_with("/assets/") { "public, max-age=31536000, immutable" } else { "no-cache" };
            assert!(headers.contains(&format!("cache-control: {cache}")), "{path}: {headers:?}");
        }
        let needed = [
            "text/html; charset=utf-8",
            "text/javascript; charset=utf-8",
            "application/wasm",
            "application/manifest+json",
            "image/webp",
        ];
        for kind in needed {
            assert!(kinds.contains(&kind), "the page has no {kind}");
        }
    }

    #[test]
    fn the_page_itself() {
        let server = Server::start(&["--port", "0"]);
        let (status, headers, body) = server.get("GET", "/");
        assert_eq!(status, "http/1.1 200 ok");
        assert!(String::from_utf8(body).unwrap().to_lowercase().starts_with("<!doctype html>"));
        for header in [
            "cache-control: no-cache",
            "cross-origin-opener-policy: same-origin",
            "cross-origin-embedder-policy: require-corp",
            "x-content-type-options: nosniff",
        ] {
            assert!(headers.contains(&header.to_owned()), "{header} is not in {headers:?}");
        }
        let policy = headers.iter().find(|h| h.starts_with("content-security-policy: ")).unwrap();
        assert!(
            policy.contains("default-src 'self'")
                && policy.contains("'wasm-unsafe-eval'")
                && !policy.contains("'unsafe-eval'"),
            "{policy}"
        );
        assert_eq!(server.get("HEAD", "/").2, b"");
        let (status, _, museum) = server.get("GET", "/museum.html");
        assert_eq!(status, "http/1.1 200 ok");
        assert!(String::from_utf8(museum).unwrap().contains("<title>Teeter: the museum of 2003</title>"));
    }

    fn header<'a>(headers: &'a [String], name: &str) -> Option<&'a str> {
        headers.iter().find_map(|header| header.strip_prefix(name)?.strip_prefix(": "))
    }

    #[test]
    fn a_file_is_compressed_and_sent_once() {
        let server = Server::start(&["--port", "0"]);
        let host = format!("Host: {}\r\n", server.address);
        let (_, plain_headers, plain) = server.ask("GET", "/", &host);
        for (accepted, encoding) in [
            ("gzip", "gzip"),
            ("br;q=0, gzip;q=0.5", "gzip"),
            ("deflate;q=0.1,GZIP", "gzip"),
            ("gzip, deflate, br, zstd", "br"),
        ] {
            let (status, headers, body) = server.ask("GET", "/", &format!("{host}Accept-Encoding: {accepted}\r\n"));
            assert_eq!((status.as_str(), header(&headers, "content-encoding")), ("http/1.1 200 ok", Some(encoding)));
            assert_eq!(header(&headers, "vary"), Some("accept-encoding"));
            let mut text = Vec::new();
            match encoding {
                "br" => brotli_decompressor::Decompressor::new(&body[..], 4096).read_to_end(&mut text).unwrap(),
                _ => flate2::read::GzDecoder::new(&body[..]).read_to_end(&mut text).unwrap(),
            };
            assert!(text == plain && body.len() < plain.len(), "{accepted}");
            let tag = header(&headers, "etag").unwrap();
            assert_ne!(Some(tag), header(&plain_headers, "etag"));
            let known = format!("{host}Accept-Encoding: {accepted}\r\nIf-None-Match: \"other\", W/{tag}\r\n");
            let (status, headers, body) = server.ask("GET", "/", &known);
            assert_eq!((status.as_str(), body.len()), ("http/1.1 304 not modified", 0));
            assert_eq!(header(&headers, "etag"), Some(tag));
        }
        for refused in ["identity", "gzip;q=0", "x-gzip-not"] {
            let (_, headers, body) = server.ask("GET", "/", &format!("{host}Accept-Encoding: {refused}\r\n"));
            assert_eq!((header(&headers, "content-encoding"), body == plain), (None, true), "{refused}");
        }
        let stale = format!("{host}If-None-Match: \"stale\"\r\n");
        assert_eq!(server.ask("GET", "/", &stale).0, "http/1.1 200 ok");
    }

    #[test]
    fn other_names_are_refused() {
        let server = Server::start(&["--port", "0"]);
        for host in ["Host: localhost:1\r\n", "Host: 127.0.0.1\r\n"] {
            assert_eq!(server.ask("GET", "/", host).0, "http/1.1 200 ok", "{host}");
        }
        for host in ["Host: example.org\r\n", "", "Host: 192.168.0.1\r\n", "Host: localhost\r\nHost: example.org\r\n"] {
            let (status, _, body) = server.ask("GET", "/", host);
            assert_eq!(status, "http/1.1 421 misdirected request", "{host}");
            assert_eq!(body, b"This server answers only to the address that it printed.\n");
        }
    }

    #[test]
    fn the_next_port_where_one_is_taken() {
        let _taken = TcpListener::bind("127.0.0.1:8080");
        let server = Server::start(&[]);
        let other = Server::start(&[]);
        let port = |server: &Server| server.address.rsplit_once(':').unwrap().1.parse::<u16>().unwrap();
        assert!(port(&server) != 8080 && port(&other) != port(&server), "{} {}", server.address, other.address);
    }

    /// Idle connections, requests sent ahead and readers that do not read: each new reader gets the
    /// page, with few files that the system lets the server open.
    #[cfg(unix)]
    #[test]
    fn a_new_reader_is_served_beside_any_number_of_others() {
        let program = env!("CARGO_BIN_EXE_teeter");
        let limited = format!("ulimit -n 64; exec {program} play --no-open --port 0");
        let mut command = Command::new("sh");
        command.args(["-c", &limited]).stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let server = Server::of(command);
        let connect = || TcpStream::connect(&server.address).unwrap();
        let request = format!("GET / HTTP/1.1\r\nHost: {}\r\n\r\n", server.address);
        let serves = |what: &str| {
            let (status, _, body) = server.get("GET", "/");
            assert_eq!((status.as_str(), body.is_empty()), ("http/1.1 200 ok", false), "{what}");
        };
        let idle: Vec<TcpStream> = (0..300).map(|_| connect()).collect();
        serves("300 idle connections");
        let begun: Vec<TcpStream> = (0..100)
            .map(|_| {
                let mut stream = connect();
                let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost:");
                stream
            })
            .collect();
        serves("100 begun requests");
        let mut ahead = connect();
        ahead.set_nonblocking(true).unwrap();
        // The reader takes nothing, so at some point nothing more can be sent.
        let bytes = request.repeat(20_000);
        let mut sent = 0;
        while let Ok(count) = ahead.write(&bytes.as_bytes()[sent..]) {
            sent += count;
            if sent == bytes.len() {
                break;
            }
        }
        serves("20,000 requests sent ahead");
        drop((idle, begun));
        serves("all others gone");
    }

    #[test]
    fn nothing_else() {
        let server = Server::start(&["--port", "0"]);
        for path in ["/nosuch", "/../Cargo.toml", "/assets/../../Cargo.toml", "/%2e%2e/Cargo.toml", "/assets"] {
            assert_eq!(server.get("GET", path).0, "http/1.1 404 not found", "{path}");
        }
        assert_eq!(server.get("POST", "/").0, "http/1.1 405 method not allowed");
    }

    #[test]
    fn a_port_that_is_taken() {
        let taken = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = taken.local_addr().unwrap().port().to_string();
        let done = common::teeter(&["play", "--no-open", "--port", &port]);
        assert_eq!(
            done.error_line(),
            format!("port {port} is taken: choose another with --port, or leave --port out for a free one")
        );
    }

    #[cfg(unix)]
    #[test]
    fn it_ends_quietly() {
        for signal in ["-INT", "-TERM"] {
            let mut server = Server::start(&["--port", "0"]);
            // An open connection must not keep it alive.
            let _open = TcpStream::connect(&server.address).unwrap();
            assert!(Command::new("kill").args([signal, &server.child.id().to_string()]).status().unwrap().success());
            let status = server.child.wait().unwrap();
            let mut said = String::new();
            server.child.stderr.as_mut().unwrap().read_to_string(&mut said).unwrap();
            assert_eq!((status.code(), said.as_str()), (Some(0), ""));
        }
    }
}
