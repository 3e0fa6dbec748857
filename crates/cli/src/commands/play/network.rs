//! Address of this machine in its network, for other devices.

use std::io;
use std::net::{IpAddr, UdpSocket};

use qrcode::QrCode;
use qrcode::render::unicode::Dense1x2;

/// Warning of `--lan`.
pub const WARNING: &str =
    "Every device in this network can now open the page. It cannot reach anything else on this machine.";

/// Returns the number of this machine in its network.
///
/// # Errors
/// When it is in none.
pub fn address() -> io::Result<IpAddr> {
    // No packet is sent: the system only chooses the interface that would reach the destination,
    // an address that is reserved for documentation.
    let socket = UdpSocket::bind("0.0.0.0:0")?;
    socket.connect("192.0.2.1:9")?;
    Ok(socket.local_addr()?.ip())
}

/// Draws an address as a QR code for a dark or light terminal; none where it does not fit.
pub fn qr_code(address: &str) -> Option<String> {
    let code = QrCode::new(address).ok()?;
    // Readers expect dark modules on a light ground, which terminals have mostly inverted.
    Some(code.render::<Dense1x2>().dark_color(Dense1x2::Light).light_color(Dense1x2::Dark).build())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_a_square_of_blocks() {
        let code = qr_code("http://192.168.178.123:8080/").unwrap();
        let lines: Vec<&str> = code.lines().collect();
        // Version 3 has 29 modules, and a quiet zone of 4 on each side; two rows are a line.
        assert_eq!((lines.len(), lines[0].chars().count()), (19, 37));
        assert!(code.chars().all(|c| "\u{2588}\u{2580}\u{2584} \n".contains(c)), "{code}");
    }
}
