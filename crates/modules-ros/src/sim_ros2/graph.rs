//! The graph of ROS 2: which readers and writers belong to which node. Each participant publishes it at the topic `ros_discovery_info`, by which
//! `ros2 node list` and `ros2 node info` know the nodes.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use ros_interfaces::{Array, Layout, Numbers, Record, Value, cdr};
use rtps::{Durability, History, Qos};

use super::endpoint::Endpoint;
use super::node::Running;
use super::ros_values::{self, Style};
use scene::Data;

/// The type of the messages.
pub(super) const TYPE: &str = "rmw_dds_common/msg/ParticipantEntitiesInfo";
/// As DDS calls the topic.
const TOPIC: &str = "ros_discovery_info";

/// Participants whose nodes are known.
const MAX_PARTICIPANTS: usize = 256;

/// The identity of a participant, a reader or a writer.
type Identity = [u8; 16];
/// Identities of readers, and of writers.
type Identities = [Vec<Identity>; 2];
/// The writers of nodes, by their full names.
type Nodes = BTreeMap<String, Vec<Identity>>;

/// What this participant publishes of its node, and what others publish of theirs.
pub(super) struct Graph {
    layout: Arc<Layout>,
    own: Endpoint,
    others: Endpoint,
    /// The state of the readers and writers that was published last.
    published: Cell<Option<(u32, usize)>>,
    /// The nodes of each participant.
    nodes: RefCell<BTreeMap<Identity, Nodes>>,
}

impl Graph {
    pub(super) fn new(running: &Rc<Running>, layout: Arc<Layout>) -> Self {
        let qos = |depth| Qos {
            durability: Durability::TransientLocal,
            history: History::KeepLast(depth),
            ..Qos::default()
        };
        Self {
            own: Endpoint::writer(running, TOPIC, &layout, qos(1)),
            // The newest of each participant.
            others: Endpoint::reader(running, TOPIC, &layout, qos(MAX_PARTICIPANTS)),
            layout,
            published: Cell::default(),
            nodes: RefCell::default(),
        }
    }

    /// Publishes what belongs to the node, if that has changed.
    pub(super) fn publish_changes(&self) {
        let generation = self.own.node.core(|core| core.generation());
        if generation.is_none() || self.published.replace(generation) == generation {
            return;
        }
        let hidden = [self.own.entity, self.others.entity];
        let identities = self.own.node.core(|core| core.identities(&hidden));
        let data = self.info(&identities.unwrap_or_default());
        if let Ok(record) = ros_values::from_data(&self.layout, &data, Style::default()) {
            self.own.publish(&record);
        }
    }

    fn info(&self, [readers, writers]: &Identities) -> Data {
        let place = &self.own.node.place;
        let namespace = match place.namespace.as_str() {
            "" => "/",
            namespace => namespace,
        };
        let node = Data::map([
            ("node_namespace", Data::text(namespace)),
            ("node_name", Data::text(&place.node)),
            (
                "reader_gid_seq",
                Data::Array(readers.iter().map(gid).collect()),
            ),
            (
                "writer_gid_seq",
                Data::Array(writers.iter().map(gid).collect()),
            ),
        ]);
        let own = self.own.node.core(|core| core.participant().to_bytes());
        Data::map([
            ("gid", gid(&own.unwrap_or_default())),
            ("node_entities_info_seq", Data::Array(vec![node])),
        ])
    }

    /// The identities of the writers of a node elsewhere, by its full name. Not on the tape.
    pub(super) fn writers_of(&self, node: &str) -> Vec<Identity> {
        while let Some(payload) = self.others.take_untaped() {
            if let Ok(info) = cdr::decode(&self.layout, &payload) {
                self.note(&info);
            }
        }
        let nodes = self.nodes.borrow();
        let of_participants = nodes.values().filter_map(|nodes| nodes.get(node));
        of_participants.flatten().copied().collect()
    }

    fn note(&self, info: &Record) {
        let Some(Value::Record(participant)) = info.get("gid") else {
            return;
        };
        let nodes = records(info, "node_entities_info_seq").map(|node| {
            let (namespace, name) = (text(node, "node_namespace"), text(node, "node_name"));
            let full = format!("{}/{name}", namespace.trim_end_matches('/'));
            let writers = records(node, "writer_gid_seq").filter_map(identity);
            (full, writers.collect())
        });
        let mut known = self.nodes.borrow_mut();
        if let Some(participant) = identity(participant) {
            known.insert(participant, nodes.collect());
        }
        while known.len() > MAX_PARTICIPANTS {
            known.pop_first();
        }
    }
}

fn gid(bytes: &Identity) -> Data {
    let numbers = bytes.iter().map(|byte| Data::Int((*byte).into()));
    Data::map([("data", Data::Array(numbers.collect()))])
}

fn records<'a>(record: &'a Record, field: &str) -> impl Iterator<Item = &'a Record> {
    let records = match record.get(field) {
        Some(Value::Array(Array::Records(records))) => records.as_slice(),
        _ => &[],
    };
    records.iter()
}

fn text(record: &Record, field: &str) -> String {
    match record.get(field) {
        Some(Value::String(bytes)) => String::from_utf8_lossy(bytes).into_owned(),
        _ => String::new(),
    }
}

fn identity(gid: &Record) -> Option<Identity> {
    match gid.get("data")? {
        Value::Array(Array::Numbers(Numbers::UInt8(bytes))) => bytes.as_slice().try_into().ok(),
        _ => None,
    }
}
