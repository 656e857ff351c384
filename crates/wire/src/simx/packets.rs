//! Messages cut into packets, and put together again (spec: legacy-remote-api 1).

use super::bytes::{ByteOrder, FieldReader, FieldWriter};
use super::{MAX_SIZE, Violation};

/// Bytes before the content of a packet.
const HEADER: usize = 6;

/// The first bytes of a packet of this machine's order, and of the other one.
const SAME_ORDER: [u8; 2] = [1, 0];
const OTHER_ORDER: [u8; 2] = [0, 1];

/// Packets that a message may have: clients read the number of those that follow as a signed one.
const MAX_PACKETS: usize = 1 << 15;

/// The largest content of a packet that clients accept.
const MAX_CONTENT: usize = 29_994;

/// Puts messages together from what arrives, in pieces of any length.
#[derive(Default)]
pub struct Packets {
    arrived: Vec<u8>,
    /// The content of the packets of the message that is incomplete.
    message: Vec<u8>,
    /// How many packets it still needs; None between messages.
    missing: Option<u16>,
    order: ByteOrder,
}

impl Packets {
    /// Adds what has arrived.
    pub fn feed(&mut self, bytes: &[u8]) {
        self.arrived.extend_from_slice(bytes);
    }

    /// The byte order of the last message.
    pub fn order(&self) -> ByteOrder {
        self.order
    }

    /// The next complete message.
    ///
    /// # Errors
    /// When the bytes are no packet, or the message is too large.
    pub fn next_message(&mut self) -> Result<Option<Vec<u8>>, Violation> {
        let mut start = 0;
        let mut complete = None;
        while complete.is_none() {
            let Some((taken, is_last)) = self.take_packet(start)? else {
                break;
            };
            start += taken;
            if is_last {
                complete = Some(std::mem::take(&mut self.message));
            }
        }
        self.arrived.drain(..start);
        Ok(complete)
    }

    /// Takes the packet at `start`: how many bytes it has, and whether it is the last of its message.
    fn take_packet(&mut self, start: usize) -> Result<Option<(usize, bool)>, Violation> {
        let bytes = &self.arrived[start..];
        let order = match bytes.first_chunk::<2>() {
            None => return Ok(None),
            Some(&SAME_ORDER) => ByteOrder::Little,
            Some(&OTHER_ORDER) => ByteOrder::Big,
            Some(_) => return Err(Violation::Malformed),
        };
        let Some(header) = bytes.get(2..HEADER) else {
            return Ok(None);
        };
        let mut header = FieldReader::new(header, order);
        let (length, missing) = (usize::from(header.short()?), header.short()?);
        if self
            .missing
            .is_some_and(|before| before != missing.wrapping_add(1))
        {
            return Err(Violation::Malformed);
        }
        if self.message.len() + length > MAX_SIZE {
            return Err(Violation::TooLarge);
        }
        let Some(content) = bytes.get(HEADER..HEADER + length) else {
            return Ok(None);
        };
        self.message.extend_from_slice(content);
        self.order = order;
        self.missing = (missing > 0).then_some(missing);
        Ok(Some((HEADER + length, missing == 0)))
    }
}

/// A message as packets of at most `max_packet` bytes; of more, where it would be too many for clients.
pub fn cut(message: &[u8], max_packet: usize, order: ByteOrder) -> Vec<u8> {
    let default = max_packet.saturating_sub(HEADER).clamp(1, MAX_CONTENT);
    let size = if message.len().div_ceil(default) <= MAX_PACKETS {
        default
    } else {
        MAX_CONTENT
    };
    let count = message.len().div_ceil(size);
    let mut writer = FieldWriter::new(order);
    // Both fit: packets are short, and clients accept no more packets than that.
    let short = |number: usize| u16::try_from(number).unwrap_or(u16::MAX);
    for (place, content) in message.chunks(size).enumerate() {
        writer.bytes(&SAME_ORDER);
        writer.short(short(content.len()));
        writer.short(short(count - 1 - place));
        writer.bytes(content);
    }
    writer.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8], piece: usize) -> Result<Vec<Vec<u8>>, Violation> {
        let (mut packets, mut messages) = (Packets::default(), Vec::new());
        for piece in bytes.chunks(piece) {
            packets.feed(piece);
            while let Some(message) = packets.next_message()? {
                messages.push(message);
            }
        }
        Ok(messages)
    }

    #[test]
    fn messages_are_the_same_in_pieces_of_any_length() {
        let message: Vec<u8> = (0..=255).cycle().take(3046).collect();
        let bytes = [
            cut(&message, 1300, ByteOrder::Little),
            cut(b"x", 1300, ByteOrder::Little),
        ]
        .concat();
        for piece in [1, 7, 1300, usize::MAX] {
            assert_eq!(
                read(&bytes, piece),
                Ok(vec![message.clone(), b"x".to_vec()])
            );
        }
    }

    #[test]
    fn lengths_are_those_of_the_original() {
        let bytes = cut(&[0; 3046], 1300, ByteOrder::Little);
        assert_eq!(bytes[..6], [1, 0, 0x0e, 5, 2, 0]);
        assert_eq!(bytes[1300..1306], [1, 0, 0x0e, 5, 1, 0]);
        assert_eq!(bytes[2600..2606], [1, 0, 0xca, 1, 0, 0]);
        assert_eq!(
            cut(&[0; 55], 1300, ByteOrder::Big)[..6],
            [1, 0, 0, 0x37, 0, 0]
        );
    }

    #[test]
    fn large_messages_have_larger_packets() {
        let bytes = cut(&vec![0; 50_000_000], 1300, ByteOrder::Little);
        let left = u16::from_le_bytes([bytes[4], bytes[5]]);
        assert_eq!(
            (u16::from_le_bytes([bytes[2], bytes[3]]), left),
            (29_994, 1667)
        );
    }

    #[test]
    fn what_is_no_packet_is_an_error() {
        assert_eq!(read(b"GET / HTTP/1.1\r\n", 100), Err(Violation::Malformed));
        assert_eq!(
            read(&[1, 0, 0, 0, 2, 0, 1, 0, 0, 0, 2, 0], 100),
            Err(Violation::Malformed),
            "2 left twice"
        );
        assert_eq!(
            read(&[1, 0, 9, 0, 0, 0, 1], 100),
            Ok(vec![]),
            "the content is still to come"
        );
    }
}
