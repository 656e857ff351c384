//! Messages and commands (spec: legacy-remote-api 1.2, 1.3).

use super::bytes::{ByteOrder, FieldReader, FieldWriter};
use super::{MAX_COMMANDS, MAX_SIZE, VERSION, Violation};

/// Bytes before the key of a command.
pub(super) const COMMAND_HEADER: usize = 26;

/// Bit of a client's status byte: the command is not merged with an equal one that waits.
const APPENDED: u8 = 1;
/// Bit of the server's status byte: the command failed.
const FAILED: u8 = 1;

/// How a command is to be executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    Oneshot,
    Blocking,
    Streaming,
    OneshotSplit,
    StreamingSplit,
    Discontinue,
    /// Modes that clients keep to themselves, and unknown ones.
    Other(u16),
}

impl Mode {
    pub(super) fn from_number(number: u16) -> Self {
        match number {
            0 => Self::Oneshot,
            1 => Self::Blocking,
            2 => Self::Streaming,
            3 => Self::OneshotSplit,
            4 => Self::StreamingSplit,
            5 => Self::Discontinue,
            other => Self::Other(other),
        }
    }

    fn number(self) -> u16 {
        match self {
            Self::Oneshot => 0,
            Self::Blocking => 1,
            Self::Streaming => 2,
            Self::OneshotSplit => 3,
            Self::StreamingSplit => 4,
            Self::Discontinue => 5,
            Self::Other(number) => number,
        }
    }

    /// Whether it stays after it was executed.
    pub(super) fn is_stream(self) -> bool {
        matches!(self, Self::Streaming | Self::StreamingSplit)
    }
}

/// A command of a client, complete.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    /// The number of the function; the upper bits of it decide on the layout of the key.
    pub id: u16,
    pub(crate) mode: Mode,
    /// What distinguishes it from others of the same id: handles, names.
    pub key: Vec<u8>,
    /// The arguments that are not part of the key.
    pub data: Vec<u8>,
    /// Streaming: milliseconds between two executions; split: bytes of a piece.
    pub(super) delay: u16,
    pub(super) is_appended: bool,
}

impl Command {
    /// The same command, whatever its data and mode.
    pub(super) fn identity(&self) -> (u16, Vec<u8>) {
        (self.id, self.key.clone())
    }
}

/// A piece of a command.
pub(super) struct Piece {
    pub command: Command,
    /// Where it belongs in the data of the whole.
    pub offset: usize,
    /// Bytes of the data of the whole.
    pub full: usize,
}

/// What a message of a client says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Head {
    pub has_checksum: bool,
    pub version: u8,
    pub id: i32,
    pub time: i32,
}

/// The state of the simulator when commands are executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stamp {
    /// Milliseconds since the simulator began.
    pub system_time: i32,
    /// Milliseconds of simulation; 0 while stopped.
    pub simulation_time: i32,
    /// Number of the scene, which changes when another is opened.
    pub scene: u16,
    /// Bit 0: not stopped; 1: paused; 2: real time.
    pub state: u8,
}

/// Reads a whole message.
///
/// # Errors
/// When a size leads out of the message, or there are too many commands.
pub(super) fn parse(message: &[u8], order: ByteOrder) -> Result<(Head, Vec<Piece>), Violation> {
    let mut reader = FieldReader::new(message, order);
    let has_checksum = reader.short()? != 0;
    let head = Head {
        has_checksum,
        version: reader.byte()?,
        id: reader.int()?,
        time: reader.int()?,
    };
    // Server time, scene and state: for replies only.
    reader.take(7)?;
    let mut pieces = Vec::new();
    while !reader.is_empty() {
        if pieces.len() >= MAX_COMMANDS {
            return Err(Violation::TooMany);
        }
        pieces.push(parse_piece(&mut reader, order)?);
    }
    Ok((head, pieces))
}

fn parse_piece(reader: &mut FieldReader<'_>, order: ByteOrder) -> Result<Piece, Violation> {
    let (size, full) = (reader.size()?, reader.size()?);
    let key_size = usize::from(reader.short()?);
    let offset = reader.size()?;
    // The number has the mode in its upper half.
    let [mode_high, mode_low, id_high, id_low] = reader.int()?.to_be_bytes();
    let delay = reader.short()?;
    // The time and the reserved byte have a meaning in replies only.
    reader.take(4)?;
    let status = reader.byte()?;
    reader.take(1)?;
    let data_size = size
        .checked_sub(COMMAND_HEADER + key_size)
        .ok_or(Violation::Malformed)?;
    let full = full
        .checked_sub(COMMAND_HEADER + key_size)
        .ok_or(Violation::Malformed)?;
    if full > MAX_SIZE {
        return Err(Violation::TooLarge);
    }
    if offset.checked_add(data_size).is_none_or(|end| end > full) {
        return Err(Violation::Malformed);
    }
    let id = u16::from_be_bytes([id_high, id_low]);
    let mode = Mode::from_number(u16::from_be_bytes([mode_high, mode_low]));
    let key = reader.take(key_size)?.to_vec();
    check_key(id, &key, order)?;
    let data = reader.take(data_size)?.to_vec();
    let command = Command {
        id,
        mode,
        key,
        data,
        delay,
        is_appended: status & APPENDED != 0,
    };
    Ok(Piece {
        command,
        offset,
        full,
    })
}

/// The layout of a key belongs to the range of the command's number.
fn check_key(id: u16, key: &[u8], order: ByteOrder) -> Result<(), Violation> {
    let mut reader = FieldReader::new(key, order);
    match id {
        0x0001..=0x0fff => {}
        0x1001..=0x1fff => drop(reader.int()?),
        0x2001..=0x2fff => drop((reader.int()?, reader.int()?)),
        0x3001..=0x33ff => drop(reader.text()?),
        0x3401..=0x34ff => drop((reader.int()?, reader.text()?, reader.text()?)),
        // Unknown: refused when it is executed.
        _ => drop(reader.rest()),
    }
    if reader.is_empty() {
        Ok(())
    } else {
        Err(Violation::Malformed)
    }
}

/// The head of a reply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ReplyHead {
    /// The message that was last received when commands were executed; -1 when none were since the last reply.
    pub id: i32,
    pub client_time: i32,
    pub stamp: Stamp,
}

/// A reply as a message: with a checksum for the old clients that send one.
pub(super) fn reply(
    head: ReplyHead,
    commands: &[u8],
    with_checksum: bool,
    order: ByteOrder,
) -> Vec<u8> {
    let mut writer = FieldWriter::new(order);
    writer.byte(VERSION);
    writer.int(head.id);
    writer.int(head.client_time);
    writer.int(head.stamp.system_time);
    writer.short(head.stamp.scene);
    writer.byte(head.stamp.state);
    writer.bytes(commands);
    let content = writer.into_bytes();
    let mut message = FieldWriter::new(order);
    message.short(if with_checksum { checksum(&content) } else { 0 });
    message.bytes(&content);
    message.into_bytes()
}

/// CRC-16 with the polynomial 0x1021, most significant bit first, without final change (XMODEM).
fn checksum(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0, |crc, &byte| {
        (0..8).fold(crc ^ u16::from(byte) << 8, |crc: u16, _| {
            if crc & 0x8000 == 0 {
                crc << 1
            } else {
                crc << 1 ^ 0x1021
            }
        })
    })
}

/// The result of a command, or a piece of it.
pub(super) struct ReplyPiece<'a> {
    pub command: &'a Command,
    pub failed: bool,
    /// Milliseconds of simulation.
    pub time: i32,
    /// Where the data belongs in the whole, and how many bytes that has.
    pub offset: usize,
    pub full: usize,
    pub data: &'a [u8],
}

impl ReplyPiece<'_> {
    pub(super) fn write(&self, writer: &mut FieldWriter) {
        let Command { id, mode, key, .. } = self.command;
        let before_data = COMMAND_HEADER + key.len();
        writer.size(before_data + self.data.len());
        writer.size(before_data + self.full);
        // The key came from a client with a length of 16 bits, so its length fits.
        writer.short(u16::try_from(key.len()).unwrap_or(u16::MAX));
        writer.size(self.offset);
        writer.int((u32::from(mode.number()) << 16 | u32::from(*id)).cast_signed());
        writer.short(0);
        writer.int(self.time);
        writer.byte(if self.failed { FAILED } else { 0 });
        writer.byte(0);
        writer.bytes(key);
        writer.bytes(self.data);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_the_known_one() {
        assert_eq!(checksum(b"123456789"), 0x31c3);
    }

    #[test]
    fn keys_have_the_layout_of_their_range() {
        let check = |id, key: &[u8]| check_key(id, key, ByteOrder::Little).is_ok();
        assert!(check(4, b"") && !check(4, b"1"));
        assert!(check(0x1001, b"1234") && !check(0x1001, b"123"));
        assert!(check(0x200e, b"12345678") && !check(0x200e, b"123456789"));
        assert!(check(0x3001, b"name\0") && !check(0x3001, b"name") && !check(0x3001, b"na\0me\0"));
        assert!(
            check(0x3401, b"1234object\0function\0") && !check(0x3401, b"1234object\0function")
        );
        assert!(check(0x7000, b"anything"));
    }
}
