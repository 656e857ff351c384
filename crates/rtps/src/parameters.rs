//! Lists of parameters, in which discovery describes participants and endpoints (DDSI-RTPS 2.3, 9.4.2.11 and 9.6.2).

use crate::bytes::{Input, pad4};

/// What a parameter says.
pub(crate) mod pid {
    pub(crate) const SENTINEL: u16 = 0x0001;
    pub(crate) const LEASE_DURATION: u16 = 0x0002;
    pub(crate) const TOPIC_NAME: u16 = 0x0005;
    pub(crate) const TYPE_NAME: u16 = 0x0007;
    pub(crate) const DOMAIN_ID: u16 = 0x000f;
    pub(crate) const PROTOCOL_VERSION: u16 = 0x0015;
    pub(crate) const VENDOR_ID: u16 = 0x0016;
    pub(crate) const RELIABILITY: u16 = 0x001a;
    pub(crate) const LIVELINESS: u16 = 0x001b;
    pub(crate) const DURABILITY: u16 = 0x001d;
    pub(crate) const DEADLINE: u16 = 0x0023;
    pub(crate) const LIFESPAN: u16 = 0x002b;
    pub(crate) const USER_DATA: u16 = 0x002c;
    pub(crate) const UNICAST_LOCATOR: u16 = 0x002f;
    pub(crate) const DEFAULT_UNICAST_LOCATOR: u16 = 0x0031;
    pub(crate) const METATRAFFIC_UNICAST_LOCATOR: u16 = 0x0032;
    pub(crate) const METATRAFFIC_MULTICAST_LOCATOR: u16 = 0x0033;
    pub(crate) const PARTICIPANT_GUID: u16 = 0x0050;
    pub(crate) const BUILTIN_ENDPOINT_SET: u16 = 0x0058;
    pub(crate) const ENDPOINT_GUID: u16 = 0x005a;
    pub(crate) const ENTITY_NAME: u16 = 0x0062;
    pub(crate) const KEY_HASH: u16 = 0x0070;
    pub(crate) const STATUS_INFO: u16 = 0x0071;
    pub(crate) const DATA_REPRESENTATION: u16 = 0x0073;
    pub(crate) const RELATED_SAMPLE_IDENTITY: u16 = 0x0083;
    pub(crate) const RELATED_SAMPLE_IDENTITY_OF_FAST_DDS: u16 = 0x800f;
}

/// How a payload begins that is such a list, in little-endian order.
pub(crate) const LIST_HEAD: [u8; 4] = [0, 3, 0, 0];

/// A list that was received.
pub(crate) struct Parameters<'a> {
    entries: Vec<(u16, &'a [u8])>,
    pub(crate) little: bool,
}

impl<'a> Parameters<'a> {
    /// The list of a payload: its head says the order of bytes.
    pub(crate) fn parse(payload: &'a [u8]) -> Option<Self> {
        let (head, body) = payload.split_at_checked(4)?;
        let little = match head {
            [0, 2, ..] => false,
            [0, 3, ..] => true,
            _ => return None,
        };
        Self::take(&mut Input::new(body, little))
    }

    /// Reads a list to its end mark.
    pub(crate) fn take(input: &mut Input<'a>) -> Option<Self> {
        let mut entries = Vec::new();
        loop {
            let (id, length) = (input.u16()?, input.u16()?);
            if id == pid::SENTINEL {
                return Some(Self {
                    entries,
                    little: input.little,
                });
            }
            entries.push((id, input.take(usize::from(length))?));
        }
    }

    pub(crate) fn bytes(&self, id: u16) -> Option<&'a [u8]> {
        self.all(id).next()
    }

    /// All values of a parameter that may be there several times.
    pub(crate) fn all(&self, id: u16) -> impl Iterator<Item = &'a [u8]> {
        self.entries
            .iter()
            .filter(move |entry| entry.0 == id)
            .map(|entry| entry.1)
    }

    pub(crate) fn input(&self, id: u16) -> Option<Input<'a>> {
        self.bytes(id).map(|bytes| Input::new(bytes, self.little))
    }

    pub(crate) fn text(&self, id: u16) -> Option<String> {
        let mut input = self.input(id)?;
        let length = input.u32()? as usize;
        let bytes = input.take(length)?;
        let text = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        String::from_utf8(text.to_vec()).ok()
    }
}

/// A list to be sent, in little-endian order.
#[derive(Default)]
pub(crate) struct ParameterList(Vec<u8>);

impl ParameterList {
    pub(crate) fn push(&mut self, id: u16, value: &[u8]) {
        self.0.extend_from_slice(&id.to_le_bytes());
        // Values are texts and fixed structures; a text longer than this is refused where it is made.
        let length = u16::try_from(value.len().next_multiple_of(4)).unwrap_or(0);
        self.0.extend_from_slice(&length.to_le_bytes());
        self.0
            .extend_from_slice(&value[..value.len().min(usize::from(length))]);
        pad4(&mut self.0);
    }

    pub(crate) fn push_text(&mut self, id: u16, text: &str) {
        let mut value = (text.len() as u32 + 1).to_le_bytes().to_vec();
        value.extend_from_slice(text.as_bytes());
        value.push(0);
        self.push(id, &value);
    }

    /// A sequence of bytes with its length.
    pub(crate) fn push_octets(&mut self, id: u16, octets: &[u8]) {
        let mut value = (octets.len() as u32).to_le_bytes().to_vec();
        value.extend_from_slice(octets);
        self.push(id, &value);
    }

    /// The list with its end mark.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.0.extend_from_slice(&[1, 0, 0, 0]);
        self.0
    }

    /// The list as a payload.
    pub(crate) fn payload(self) -> Vec<u8> {
        [LIST_HEAD.to_vec(), self.finish()].concat()
    }
}
