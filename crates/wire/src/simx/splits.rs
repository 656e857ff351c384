//! Results that are sent in pieces, one with each reply.

use std::sync::Arc;

use super::bytes::FieldWriter;
use super::message::{Command, ReplyPiece};

/// Pieces are not smaller than this.
const MIN_PIECE: usize = 50;

/// A result of which not all was sent.
pub(super) struct Split {
    /// The place of its command.
    pub place: u64,
    pub command: Arc<Command>,
    pub failed: bool,
    /// Milliseconds of simulation at the execution.
    pub time: i32,
    pub data: Vec<u8>,
    pub sent: usize,
}

/// Bytes of a piece, as the command wants them.
pub(super) fn size_of_piece(command: &Command) -> usize {
    usize::from(command.delay).max(MIN_PIECE)
}

impl Split {
    /// Writes the next piece; returns whether it is the last.
    pub(super) fn write_next(&mut self, writer: &mut FieldWriter) -> bool {
        let end = self
            .data
            .len()
            .min(self.sent + size_of_piece(&self.command));
        let (offset, full) = (self.sent, self.data.len());
        let (failed, time) = (self.failed, self.time);
        ReplyPiece {
            command: &self.command,
            failed,
            time,
            offset,
            full,
            data: &self.data[offset..end],
        }
        .write(writer);
        self.sent = end;
        end == full
    }
}
