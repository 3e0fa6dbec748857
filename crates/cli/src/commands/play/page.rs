//! Built page inside the program, and responses with its files.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::LazyLock;

use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, HeaderValue, Response, StatusCode, Uri, header};
use flate2::Compression;
use flate2::write::GzEncoder;
use rust_embed::{EmbeddedFile, RustEmbed};

#[derive(RustEmbed)]
#[folder = "../../web/dist"]
struct Dist;

/// Files by their paths. They are compressed once, not for each request. Browsers take Brotli from
/// this machine and over HTTPS, and gzip from others in the house.
static FILES: LazyLock<BTreeMap<String, PageFile>> = LazyLock::new(|| {
    let file = |path: std::borrow::Cow<'static, str>| {
        let found = Dist::get(&path)?;
        let brotli = Dist::get(&format!("{path}{BROTLI}")).map(|file| Bytes::from(file.data.into_owned()));
        let file = PageFile::new(&path, found, brotli);
        Some((path.into_owned(), file))
    };
    Dist::iter().filter(|path| !path.ends_with(BROTLI)).filter_map(file).collect()
});

/// Ending of the files that the build of the page has compressed by Brotli, which takes seconds.
const BROTLI: &str = ".br";

/// Admits nothing from other hosts. Workers and WebAssembly are the page's own; three.js and the
/// panel set styles on elements.
const CONTENT_SECURITY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; style-src 'self' 'unsafe-inline'; \
     img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// File of the page.
struct PageFile {
    kind: HeaderValue,
    cache: &'static str,
    /// Hash of the content.
    hash: String,
    plain: Bytes,
    /// Names of encodings and the content in them, where that is smaller; the smallest first.
    encodings: Vec<(&'static str, Bytes)>,
}

impl PageFile {
    fn new(path: &str, file: EmbeddedFile, brotli: Option<Bytes>) -> Self {
        let hash = file.metadata.sha256_hash()[..16].iter().map(|byte| format!("{byte:02x}")).collect();
        let plain = Bytes::from(file.data.into_owned());
        let encodings = [("br", brotli), ("gzip", gzip(&plain))].into_iter();
        let encodings = encodings.filter_map(|(name, bytes)| Some((name, bytes?)));
        let encodings = encodings.filter(|(_, bytes)| bytes.len() < plain.len()).collect();
        // Built files in this folder have a hash of their content in their names. Others are kept
        // and asked for again with the hash.
        let cache = if path.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-cache" };
        let kind = HeaderValue::from_str(&content_type(file.metadata.mimetype()));
        let kind = kind.unwrap_or(HeaderValue::from_static("application/octet-stream"));
        Self { kind, cache, hash, plain, encodings }
    }

    /// Response to a request with these headers: the file, or that the reader has it.
    fn response(&self, request: &HeaderMap) -> Response<Body> {
        let encoded = self.encodings.iter().find(|(name, _)| accepts(request, name));
        let (bytes, tag) = match encoded {
            Some((name, bytes)) => (bytes, format!("\"{}-{name}\"", self.hash)),
            None => (&self.plain, format!("\"{}\"", self.hash)),
        };
        let is_known = has_tag(request, &tag);
        let mut response = Response::new(if is_known { Body::empty() } else { Body::from(bytes.clone()) });
        let headers = response.headers_mut();
        if !is_known {
            headers.insert(header::CONTENT_TYPE, self.kind.clone());
            if let Some((name, _)) = encoded {
                headers.insert(header::CONTENT_ENCODING, HeaderValue::from_static(name));
            }
        }
        headers.insert(header::CACHE_CONTROL, HeaderValue::from_static(self.cache));
        headers.insert(header::VARY, HeaderValue::from_static("accept-encoding"));
        if let Ok(tag) = HeaderValue::from_str(&tag) {
            headers.insert(header::ETAG, tag);
        }
        if is_known {
            *response.status_mut() = StatusCode::NOT_MODIFIED;
        }
        response
    }
}

/// Prepares all files, so that the first reader does not wait.
pub fn prepare() {
    LazyLock::force(&FILES);
}

/// Returns the file at an address; `/` is the page itself.
pub async fn file(uri: Uri, request: HeaderMap) -> Response<Body> {
    let path = match uri.path().trim_start_matches('/') {
        "" => "index.html",
        path => path,
    };
    let mut response = match FILES.get(path) {
        Some(file) => file.response(&request),
        None => message(StatusCode::NOT_FOUND, "There is no such page.\n"),
    };
    isolate(response.headers_mut());
    response
}

/// Returns a response with a line of text.
pub fn message(status: StatusCode, text: &'static str) -> Response<Body> {
    let mut response = Response::new(Body::from(text));
    *response.status_mut() = status;
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("text/plain; charset=utf-8"));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    response
}

fn gzip(plain: &[u8]) -> Option<Bytes> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::default());
    packer.write_all(plain).ok()?;
    packer.finish().ok().map(Bytes::from)
}

/// Returns true if a list of a header has an entry for which `test` is true. An entry is a name and
/// its parameters.
fn any_entry(request: &HeaderMap, name: header::HeaderName, test: impl Fn(&str, &str) -> bool) -> bool {
    let lists = request.get_all(name).into_iter().filter_map(|value| value.to_str().ok());
    lists.flat_map(|list| list.split(',')).any(|entry| {
        let (name, parameters) = entry.split_once(';').unwrap_or((entry, ""));
        test(name.trim(), parameters.trim())
    })
}

/// Returns true if a request takes content in an encoding.
fn accepts(request: &HeaderMap, encoding: &str) -> bool {
    any_entry(request, header::ACCEPT_ENCODING, |name, parameters| {
        let quality = parameters.strip_prefix("q=").and_then(|q| q.trim().parse::<f64>().ok()).unwrap_or(1.0);
        name.eq_ignore_ascii_case(encoding) && quality > 0.0
    })
}

fn has_tag(request: &HeaderMap, tag: &str) -> bool {
    any_entry(request, header::IF_NONE_MATCH, |name, _| name == "*" || name.trim_start_matches("W/") == tag)
}

fn content_type(guess: &str) -> String {
    if guess.starts_with("text/") { format!("{guess}; charset=utf-8") } else { guess.to_owned() }
}

fn isolate(headers: &mut HeaderMap) {
    headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(CONTENT_SECURITY));
    // Isolation from other origins gives workers shared memory and precise clocks.
    headers.insert("cross-origin-opener-policy", HeaderValue::from_static("same-origin"));
    headers.insert("cross-origin-embedder-policy", HeaderValue::from_static("require-corp"));
    headers.insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(header::REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
}
