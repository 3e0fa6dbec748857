//! Built page inside the program, and responses with its files.

use axum::body::Body;
use axum::http::{HeaderMap, HeaderValue, Response, StatusCode, Uri, header};
use rust_embed::RustEmbed;

#[derive(RustEmbed)]
#[folder = "../../web/dist"]
struct Dist;

/// Admits nothing from other hosts. Workers and WebAssembly are the page's own; three.js and the
/// panel set styles on elements.
const CONTENT_SECURITY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; style-src 'self' 'unsafe-inline'; \
     img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Returns the file at an address; `/` is the page itself.
pub async fn file(uri: Uri) -> Response<Body> {
    let path = match uri.path().trim_start_matches('/') {
        "" => "index.html",
        path => path,
    };
    let (status, kind, cache, bytes) = match Dist::get(path) {
        Some(found) => {
            let kind = content_type(found.metadata.mimetype());
            // Built files in this folder have a hash of their content in their names.
            let cache = if path.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-store" };
            (StatusCode::OK, kind, cache, found.data.into_owned())
        }
        None => {
            let kind = "text/plain; charset=utf-8".to_owned();
            (StatusCode::NOT_FOUND, kind, "no-store", b"There is no such page.\n".to_vec())
        }
    };
    let mut response = Response::new(Body::from(bytes));
    *response.status_mut() = status;
    set_headers(response.headers_mut(), &kind, cache);
    response
}

fn content_type(guess: &str) -> String {
    if guess.starts_with("text/") { format!("{guess}; charset=utf-8") } else { guess.to_owned() }
}

fn set_headers(headers: &mut HeaderMap, kind: &str, cache: &'static str) {
    let kind = HeaderValue::from_str(kind).unwrap_or(HeaderValue::from_static("application/octet-stream"));
    headers.insert(header::CONTENT_TYPE, kind);
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static(cache));
    headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(CONTENT_SECURITY));
    // Isolation from other origins gives workers shared memory and precise clocks.
    headers.insert("cross-origin-opener-policy", HeaderValue::from_static("same-origin"));
    headers.insert("cross-origin-embedder-policy", HeaderValue::from_static("require-corp"));
    headers.insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(header::REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
}
