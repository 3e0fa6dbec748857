//! Names under which the server may be addressed.
//!
//! A page of another site can point a name of its own at this machine, and would then count as the
//! origin of what it reads here. So only names are answered that no other site can have.

use std::net::IpAddr;

use axum::body::Body;
use axum::extract::Request;
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::Next;
use axum::response::Response;

use super::page;

/// Machines that are answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Audience {
    /// This machine alone.
    Loopback,
    /// All machines of the network, by the number of this one.
    Network,
}

/// Refuses requests to a name that is not one of this server.
pub async fn check(audience: Audience, request: Request, next: Next) -> Response<Body> {
    if is_own(audience, request.headers()) {
        next.run(request).await
    } else {
        page::message(StatusCode::MISDIRECTED_REQUEST, "This server answers only to the address that it printed.\n")
    }
}

/// Returns true if a request names this server, with any port: that of a tunnel differs.
fn is_own(audience: Audience, request: &HeaderMap) -> bool {
    let mut hosts = request.get_all(header::HOST).iter();
    let (Some(host), None) = (hosts.next(), hosts.next()) else { return false };
    let Ok(authority) = host.to_str().unwrap_or_default().parse::<axum::http::uri::Authority>() else { return false };
    let name = authority.host();
    if name.eq_ignore_ascii_case("localhost") {
        return true;
    }
    // A number cannot be pointed elsewhere by another site.
    match name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>() {
        Ok(number) => number.is_loopback() || audience == Audience::Network,
        Err(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    fn is_answered(audience: Audience, host: &str) -> bool {
        let headers = HeaderMap::from_iter([(header::HOST, HeaderValue::from_str(host).unwrap())]);
        is_own(audience, &headers)
    }

    #[test]
    fn only_own_names_are_answered() {
        for host in ["127.0.0.1:8080", "localhost:8080", "LocalHost", "127.0.0.1", "[::1]:9000", "127.8.9.1:1"] {
            assert!(is_answered(Audience::Loopback, host) && is_answered(Audience::Network, host), "{host}");
        }
        for host in ["192.168.1.7:8080", "10.0.0.1", "[fe80::1]:80"] {
            assert!(!is_answered(Audience::Loopback, host) && is_answered(Audience::Network, host), "{host}");
        }
        for host in ["example.org", "localhost.example.org:8080", "127.0.0.1.example.org", "", "a b", "127.0.0.1@x.org"]
        {
            assert!(!is_answered(Audience::Loopback, host) && !is_answered(Audience::Network, host), "{host}");
        }
        assert!(!is_own(Audience::Network, &HeaderMap::new()));
    }
}
