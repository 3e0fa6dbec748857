//! `teeter play`: the page comes whole from 127.0.0.1, each file with its type and its headers, and
//! Ctrl-C ends it quietly.

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
            let mut child = common::command(&[&["play", "--no-open"], args].concat()).spawn().unwrap();
            let mut line = String::new();
            BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
            let address =
                line.strip_prefix("Teeter is at http://").and_then(|l| l.strip_suffix("/ (Ctrl-C ends it)\n"));
            let address = address.unwrap_or_else(|| panic!("{line:?}")).to_owned();
            Self { child, address }
        }

        /// Status line, headers in lower case, and body.
        fn get(&self, method: &str, path: &str) -> (String, Vec<String>, Vec<u8>) {
            let mut stream = TcpStream::connect(&self.address).unwrap();
            write!(stream, "{method} {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", self.address).unwrap();
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
            if path.is_dir() { built_files(&path, into) } else { into.push(path) }
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
                _ => continue,
            };
            kinds.push(kind);
            assert!(headers.contains(&format!("content-type: {kind}")), "{path}: {headers:?}");
            let cache = if path.starts_with("/assets/") { "public, max-age=31536000, immutable" } else { "no-store" };
            assert!(headers.contains(&format!("cache-control: {cache}")), "{path}: {headers:?}");
        }
        for kind in ["text/html; charset=utf-8", "text/javascript; charset=utf-8", "application/wasm"] {
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
            "cache-control: no-store",
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
