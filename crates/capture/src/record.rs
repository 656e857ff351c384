//! The records of a capture.

use crate::value::{Input, Recorded, write_bytes, write_number};

/// Bytes of content in one record; larger contents are several.
pub(crate) const PIECE: usize = 1 << 20;

/// How a run was started: what a replay starts it with again.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Header {
    /// The version of the program.
    pub version: String,
    /// The command line, without the program's name.
    pub args: Vec<String>,
    /// Further facts by name: the folder the program was in, for example.
    pub facts: Vec<(String, String)>,
}

impl Recorded for Header {
    fn write(&self, out: &mut Vec<u8>) {
        self.version.write(out);
        self.args.write(out);
        self.facts.write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some(Self {
            version: Recorded::read(input)?,
            args: Recorded::read(input)?,
            facts: Recorded::read(input)?,
        })
    }
}

/// One thing that happened, in the order of the run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Record {
    /// The first record.
    Header(Header),
    /// The name of the next kind of inputs; they are numbered from 0.
    Kind(String),
    /// A piece of a content, which is the next one when it is complete; contents are numbered from 0.
    Content {
        /// The bytes of the piece.
        piece: Vec<u8>,
        /// Whether the content is complete with it.
        is_last: bool,
    },
    /// Something came from outside.
    Input {
        /// The number of its kind.
        kind: u64,
        /// The value.
        value: Vec<u8>,
    },
    /// An iteration of the loop begins.
    Turn,
    /// A simulation step is over.
    Step {
        /// Its number in the capture, from 1.
        step: u64,
        /// The hash of the state after it.
        hash: u64,
    },
    /// Something that the capture lacks, in words.
    Lacks(String),
    /// The run has ended.
    End,
}

const HEADER: u8 = 0;
const KIND: u8 = 1;
const CONTENT: u8 = 2;
const LAST_CONTENT: u8 = 3;
const INPUT: u8 = 4;
const STEP: u8 = 5;
const LACKS: u8 = 6;
const END: u8 = 7;
const TURN: u8 = 8;

impl Record {
    /// Appends an input, as [`Record::Input`] is written.
    pub(crate) fn write_input(kind: u64, value: &[u8], out: &mut Vec<u8>) {
        out.push(INPUT);
        write_number(kind, out);
        write_bytes(value, out);
    }
}

impl Recorded for Record {
    fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Header(header) => {
                out.push(HEADER);
                header.write(out);
            }
            Self::Kind(name) => {
                out.push(KIND);
                name.write(out);
            }
            Self::Content { piece, is_last } => {
                out.push(if *is_last { LAST_CONTENT } else { CONTENT });
                write_bytes(piece, out);
            }
            Self::Input { kind, value } => Self::write_input(*kind, value, out),
            Self::Step { step, hash } => {
                out.push(STEP);
                write_number(*step, out);
                out.extend_from_slice(&hash.to_le_bytes());
            }
            Self::Lacks(what) => {
                out.push(LACKS);
                what.write(out);
            }
            Self::Turn => out.push(TURN),
            Self::End => out.push(END),
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some(match input.byte()? {
            HEADER => Self::Header(Header::read(input)?),
            KIND => Self::Kind(Recorded::read(input)?),
            tag @ (CONTENT | LAST_CONTENT) => Self::Content {
                piece: input.bytes()?.to_vec(),
                is_last: tag == LAST_CONTENT,
            },
            INPUT => Self::Input {
                kind: input.number()?,
                value: input.bytes()?.to_vec(),
            },
            STEP => Self::Step {
                step: input.number()?,
                hash: u64::from_le_bytes(input.take(8)?.try_into().ok()?),
            },
            LACKS => Self::Lacks(Recorded::read(input)?),
            TURN => Self::Turn,
            END => Self::End,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_come_back() {
        let records = [
            Record::Header(Header {
                version: "1".into(),
                args: vec!["run".into(), "ü.lua".into()],
                facts: vec![("folder".into(), "/".into())],
            }),
            Record::Kind("clock".into()),
            Record::Content {
                piece: vec![1, 2],
                is_last: false,
            },
            Record::Content {
                piece: vec![],
                is_last: true,
            },
            Record::Input {
                kind: 300,
                value: vec![0; 200],
            },
            Record::Step {
                step: 7,
                hash: u64::MAX,
            },
            Record::Turn,
            Record::Lacks("a plugin".into()),
            Record::End,
        ];
        let mut bytes = Vec::new();
        records.iter().for_each(|record| record.write(&mut bytes));
        let mut input = Input::new(&bytes);
        for record in &records {
            assert_eq!(Record::read(&mut input).as_ref(), Some(record));
        }
        assert!(input.is_empty());
        assert_eq!(Record::read(&mut Input::new(&[99])), None);
    }
}
