//! What participants say of themselves and of their writers and readers (DDSI-RTPS 2.3, 8.5 and 9.6.2.2).

use std::net::{Ipv4Addr, SocketAddrV4};
use std::time::Duration;

use crate::bytes::Input;
use crate::compose::{VENDOR, VERSION};
use crate::guid::{EntityId, Guid, Prefix};
use crate::parameters::{ParameterList, Parameters, pid};
use crate::qos::{Durability, History, Liveliness, Qos, Reliability};

/// The writers and readers of the protocol's own topics that this side has.
const BUILTIN_ENDPOINTS: u32 = 0b1100_0011_1111;

/// A participant, as it describes itself.
#[derive(Debug, Clone)]
pub(crate) struct ParticipantData {
    pub(crate) prefix: Prefix,
    pub(crate) vendor: [u8; 2],
    pub(crate) builtin_endpoints: u32,
    /// Where its own topics are received.
    pub(crate) metatraffic: Vec<SocketAddrV4>,
    /// Where topics of programs are received, if the endpoint says nothing else.
    pub(crate) unicast: Vec<SocketAddrV4>,
    pub(crate) lease: Duration,
}

/// How this side describes itself.
pub(crate) struct OwnParticipant<'a> {
    pub(crate) prefix: Prefix,
    pub(crate) domain: u32,
    pub(crate) unicast: SocketAddrV4,
    pub(crate) multicast: Option<SocketAddrV4>,
    pub(crate) name: &'a str,
    pub(crate) user_data: &'a [u8],
    pub(crate) lease: Duration,
}

/// A writer or reader, as discovery describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Endpoint {
    /// Which one.
    pub guid: Guid,
    /// The topic's name on the wire.
    pub topic: String,
    /// The type's name on the wire.
    pub type_name: String,
    /// What is offered or requested.
    pub qos: Qos,
    /// Bytes that programs attach, such as the hash of the type.
    pub user_data: Vec<u8>,
    pub(crate) unicast: Vec<SocketAddrV4>,
    /// Whether it takes or sends plain CDR.
    pub(crate) is_plain_cdr: bool,
}

impl OwnParticipant<'_> {
    pub(crate) fn payload(&self) -> Vec<u8> {
        let mut list = ParameterList::default();
        list.push(pid::PROTOCOL_VERSION, &VERSION);
        list.push(pid::VENDOR_ID, &VENDOR);
        list.push(
            pid::PARTICIPANT_GUID,
            &Guid {
                prefix: self.prefix,
                entity: EntityId::PARTICIPANT,
            }
            .to_bytes(),
        );
        list.push(pid::DOMAIN_ID, &self.domain.to_le_bytes());
        list.push(pid::BUILTIN_ENDPOINT_SET, &BUILTIN_ENDPOINTS.to_le_bytes());
        list.push(pid::METATRAFFIC_UNICAST_LOCATOR, &locator(self.unicast));
        if let Some(multicast) = self.multicast {
            list.push(pid::METATRAFFIC_MULTICAST_LOCATOR, &locator(multicast));
        }
        list.push(pid::DEFAULT_UNICAST_LOCATOR, &locator(self.unicast));
        list.push(pid::LEASE_DURATION, &duration(Some(self.lease)));
        list.push_text(pid::ENTITY_NAME, self.name);
        list.push_octets(pid::USER_DATA, self.user_data);
        list.payload()
    }
}

impl ParticipantData {
    pub(crate) fn parse(payload: &[u8]) -> Option<Self> {
        let list = Parameters::parse(payload)?;
        let addresses = |id| {
            list.all(id)
                .filter_map(|bytes| address(Input::new(bytes, list.little)))
                .collect()
        };
        Some(Self {
            prefix: Guid::from_bytes(list.bytes(pid::PARTICIPANT_GUID)?.try_into().ok()?).prefix,
            vendor: list.bytes(pid::VENDOR_ID)?.get(..2)?.try_into().ok()?,
            builtin_endpoints: list
                .input(pid::BUILTIN_ENDPOINT_SET)
                .and_then(|mut input| input.u32())
                .unwrap_or(0),
            metatraffic: addresses(pid::METATRAFFIC_UNICAST_LOCATOR),
            unicast: addresses(pid::DEFAULT_UNICAST_LOCATOR),
            // The protocol's default is 100 s; with an infinite lease, participants that are gone would stay.
            lease: parse_duration(list.input(pid::LEASE_DURATION))
                .flatten()
                .unwrap_or(Duration::from_secs(100)),
        })
    }
}

impl Endpoint {
    pub(crate) fn payload(&self) -> Vec<u8> {
        let participant = Guid {
            prefix: self.guid.prefix,
            entity: EntityId::PARTICIPANT,
        };
        let mut list = ParameterList::default();
        list.push(pid::ENDPOINT_GUID, &self.guid.to_bytes());
        list.push(pid::PARTICIPANT_GUID, &participant.to_bytes());
        list.push_text(pid::TOPIC_NAME, &self.topic);
        list.push_text(pid::TYPE_NAME, &self.type_name);
        push_qos(&mut list, &self.qos);
        self.unicast
            .iter()
            .for_each(|address| list.push(pid::UNICAST_LOCATOR, &locator(*address)));
        // One representation: XCDR1.
        list.push(pid::DATA_REPRESENTATION, &[1, 0, 0, 0, 0, 0, 0, 0]);
        if !self.user_data.is_empty() {
            list.push_octets(pid::USER_DATA, &self.user_data);
        }
        list.payload()
    }

    pub(crate) fn parse(payload: &[u8]) -> Option<Self> {
        let list = Parameters::parse(payload)?;
        let guid = Guid::from_bytes(list.bytes(pid::ENDPOINT_GUID)?.try_into().ok()?);
        Some(Self {
            guid,
            topic: list.text(pid::TOPIC_NAME)?,
            type_name: list.text(pid::TYPE_NAME)?,
            qos: parse_qos(&list, guid.entity.is_reader()),
            user_data: list
                .input(pid::USER_DATA)
                .and_then(octets)
                .unwrap_or_default(),
            unicast: list
                .all(pid::UNICAST_LOCATOR)
                .filter_map(|bytes| address(Input::new(bytes, list.little)))
                .collect(),
            is_plain_cdr: list
                .input(pid::DATA_REPRESENTATION)
                .is_none_or(|input| has_plain_cdr(input).unwrap_or(true)),
        })
    }

    /// Which endpoint has ended, by the key alone.
    pub(crate) fn parse_key(payload: &[u8]) -> Option<Guid> {
        Some(Guid::from_bytes(
            Parameters::parse(payload)?
                .bytes(pid::ENDPOINT_GUID)?
                .try_into()
                .ok()?,
        ))
    }

    /// The key alone, as a payload.
    pub(crate) fn key_payload(guid: Guid) -> Vec<u8> {
        let mut list = ParameterList::default();
        list.push(pid::ENDPOINT_GUID, &guid.to_bytes());
        list.payload()
    }
}

fn octets(mut input: Input) -> Option<Vec<u8>> {
    let length = input.u32()? as usize;
    input.take(length).map(<[u8]>::to_vec)
}

fn has_plain_cdr(mut input: Input) -> Option<bool> {
    let count = input.u32()?;
    let mut representations = (0..count.min(16)).map_while(|_| input.u16());
    Some(count == 0 || representations.any(|representation| representation == 0))
}

fn push_qos(list: &mut ParameterList, qos: &Qos) {
    let reliability: u32 = if qos.is_reliable() { 2 } else { 1 };
    let max_blocking = duration(Some(Duration::from_millis(100)));
    list.push(
        pid::RELIABILITY,
        &[&reliability.to_le_bytes()[..], &max_blocking].concat(),
    );
    let durability: u32 = match qos.durability {
        Durability::Volatile => 0,
        Durability::TransientLocal => 1,
        Durability::Transient => 2,
        Durability::Persistent => 3,
    };
    list.push(pid::DURABILITY, &durability.to_le_bytes());
    list.push(pid::DEADLINE, &duration(qos.deadline));
    list.push(pid::LIFESPAN, &duration(qos.lifespan));
    let liveliness: u32 = match qos.liveliness {
        Liveliness::Automatic => 0,
        Liveliness::ManualByParticipant => 1,
        Liveliness::ManualByTopic => 2,
    };
    list.push(
        pid::LIVELINESS,
        &[
            &liveliness.to_le_bytes()[..],
            &duration(qos.liveliness_lease),
        ]
        .concat(),
    );
}

/// Policies that are not said have the protocol's defaults: writers are reliable, readers are not.
fn parse_qos(list: &Parameters, is_reader: bool) -> Qos {
    let kind = |id| list.input(id).and_then(|mut input| input.u32());
    let reliability = match kind(pid::RELIABILITY) {
        Some(1) => Reliability::BestEffort,
        None if is_reader => Reliability::BestEffort,
        _ => Reliability::Reliable,
    };
    let liveliness_lease = list.input(pid::LIVELINESS).and_then(|mut input| {
        input.u32()?;
        parse_duration(Some(input))
    });
    Qos {
        reliability,
        durability: match kind(pid::DURABILITY) {
            Some(1) => Durability::TransientLocal,
            Some(2) => Durability::Transient,
            Some(3) => Durability::Persistent,
            _ => Durability::Volatile,
        },
        history: History::KeepLast(1),
        deadline: parse_duration(list.input(pid::DEADLINE)).flatten(),
        lifespan: parse_duration(list.input(pid::LIFESPAN)).flatten(),
        liveliness: match kind(pid::LIVELINESS) {
            Some(1) => Liveliness::ManualByParticipant,
            Some(2) => Liveliness::ManualByTopic,
            _ => Liveliness::Automatic,
        },
        liveliness_lease: liveliness_lease.flatten(),
    }
}

/// Seconds and fractions of 2^-32 s; `None` is without end.
fn duration(duration: Option<Duration>) -> [u8; 8] {
    let (seconds, fraction) = duration.map_or((0x7fff_ffff, 0xffff_ffff), |duration| {
        let seconds = duration.as_secs().min(0x7fff_fffe) as u32;
        (seconds, fraction_of(duration.subsec_nanos()))
    });
    let mut bytes = [0; 8];
    bytes[..4].copy_from_slice(&seconds.to_le_bytes());
    bytes[4..].copy_from_slice(&fraction.to_le_bytes());
    bytes
}

/// Nanoseconds as fractions of 2^-32 s, rounded up so that what is read back is not less.
pub(crate) fn fraction_of(nanoseconds: u32) -> u32 {
    (u64::from(nanoseconds) << 32).div_ceil(1_000_000_000) as u32
}

fn parse_duration(input: Option<Input>) -> Option<Option<Duration>> {
    let mut input = input?;
    let (seconds, fraction) = (input.u32()?, input.u32()?);
    if seconds >= 0x7fff_ffff {
        return Some(None);
    }
    let nanoseconds = (u64::from(fraction) * 1_000_000_000) >> 32;
    Some(Some(Duration::new(u64::from(seconds), nanoseconds as u32)))
}

/// An address of UDP over IPv4.
fn locator(address: SocketAddrV4) -> [u8; 24] {
    let mut bytes = [0; 24];
    bytes[..4].copy_from_slice(&1u32.to_le_bytes());
    bytes[4..8].copy_from_slice(&u32::from(address.port()).to_le_bytes());
    bytes[20..].copy_from_slice(&address.ip().octets());
    bytes
}

fn address(mut input: Input) -> Option<SocketAddrV4> {
    let (kind, port) = (input.u32()?, u16::try_from(input.u32()?).ok()?);
    input.take(12)?;
    let ip = Ipv4Addr::from(input.array::<4>()?);
    (kind == 1 && port != 0).then_some(SocketAddrV4::new(ip, port))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_of_an_endpoint_is_read_back() {
        let endpoint = Endpoint {
            guid: Guid {
                prefix: [7; 12],
                entity: EntityId::user_writer(3),
            },
            topic: "rt/chatter".into(),
            type_name: "std_msgs::msg::dds_::String_".into(),
            qos: Qos {
                durability: Durability::TransientLocal,
                deadline: Some(Duration::from_millis(20)),
                liveliness_lease: Some(Duration::from_secs(3)),
                liveliness: Liveliness::ManualByTopic,
                history: History::KeepLast(1),
                ..Qos::default()
            },
            user_data: b"typehash=x;".to_vec(),
            unicast: vec![SocketAddrV4::new(Ipv4Addr::LOCALHOST, 7411)],
            is_plain_cdr: true,
        };
        assert_eq!(
            Endpoint::parse(&endpoint.payload()).as_ref(),
            Some(&endpoint)
        );
        assert_eq!(
            Endpoint::parse_key(&Endpoint::key_payload(endpoint.guid)),
            Some(endpoint.guid)
        );
        let payload = endpoint.payload();
        for end in 0..payload.len() {
            assert!(
                Endpoint::parse(&payload[..end]).is_none(),
                "cut after {end} bytes"
            );
        }
    }
}
