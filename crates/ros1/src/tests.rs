//! Nodes against a master that knows only what they need, on the loopback.

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use crate::network::{NodeNetwork, Place};
use crate::tcpros::Server;
use crate::xmlrpc::{call_text, read_call, response_text};
use crate::{Error, MessageType, Node, NodeSettings, ServiceType, XmlRpcValue, http};

#[derive(Default)]
struct Graph {
    publishers: BTreeMap<String, Vec<String>>,
    subscribers: BTreeMap<String, Vec<String>>,
    services: BTreeMap<String, String>,
    parameters: BTreeMap<String, XmlRpcValue>,
}

struct Master {
    server: Server,
    graph: Arc<Mutex<Graph>>,
}

impl Master {
    fn start() -> Self {
        let graph = Arc::new(Mutex::new(Graph::default()));
        let theirs = graph.clone();
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
        let serve = move |mut stream| drop(http::serve(&mut stream, |body| answer(&theirs, body)));
        Self {
            server: Server::start(listener, "master", serve).expect("a thread"),
            graph,
        }
    }

    fn node(&self, name: &str) -> Node {
        let master = format!("http://127.0.0.1:{}", self.server.port());
        let settings = NodeSettings {
            master,
            network: NodeNetwork::Loopback,
            namespace: String::new(),
            name: name.into(),
        };
        Node::new(&settings).expect("a node")
    }

    fn publishers(&self, topic: &str) -> usize {
        self.graph
            .lock()
            .expect("no panic")
            .publishers
            .get(topic)
            .map_or(0, Vec::len)
    }
}

#[test]
fn a_node_without_a_master_works_alone() {
    let settings = NodeSettings {
        master: "http://127.0.0.1:1".into(),
        network: NodeNetwork::Loopback,
        namespace: "/robots".into(),
        name: "arm".into(),
    };
    assert!(matches!(Node::new(&settings), Err(Error::Master { .. })));
    let node = Node::without_master(&settings).expect("a node");
    assert!(node.has_no_master());
    let message_type = MessageType {
        name: "std_msgs/String".into(),
        md5: "992ce8a1687cec8c8bd883ec73ca41d1".into(),
        definition: "string data\n".into(),
    };
    let publisher = node.publish("/said", &message_type, 1, false).unwrap();
    let subscriber = node.subscribe("/said", &message_type, 1).unwrap();
    publisher.publish(vec![0; 4]);
    assert!(subscriber.take().is_none());
    // Parameters are the node's own.
    let value = XmlRpcValue::Int(3);
    assert_eq!(node.parameter("~speed").unwrap(), None);
    node.set_parameter("speed", value.clone()).unwrap();
    assert_eq!(node.parameter("/robots/speed").unwrap(), Some(value));
    assert_eq!(
        node.search_parameter("speed").unwrap().as_deref(),
        Some("/robots/speed")
    );
    assert_eq!(node.search_parameter("force").unwrap(), None);
    node.delete_parameter("speed").unwrap();
    assert!(!node.has_parameter("speed").unwrap());
    assert!(matches!(
        node.delete_parameter("speed"),
        Err(Error::Refused { .. })
    ));
}

fn answer(graph: &Mutex<Graph>, body: &[u8]) -> String {
    let (method, arguments) = read_call(body).expect("a call");
    let texts: Vec<&str> = arguments
        .iter()
        .map(|value| value.as_text().unwrap_or_default())
        .collect();
    let mut graph = graph.lock().expect("no panic");
    let refuse = || Err("no".to_string());
    let result = match (method.as_str(), &texts[1..]) {
        ("registerPublisher", [topic, _, api]) => {
            graph
                .publishers
                .entry(topic.to_string())
                .or_default()
                .push(api.to_string());
            update(&graph, topic);
            Ok(XmlRpcValue::Array(Vec::new()))
        }
        ("registerSubscriber", [topic, _, api]) => {
            graph
                .subscribers
                .entry(topic.to_string())
                .or_default()
                .push(api.to_string());
            let publishers = graph.publishers.get(*topic).cloned().unwrap_or_default();
            Ok(XmlRpcValue::Array(
                publishers.into_iter().map(XmlRpcValue::String).collect(),
            ))
        }
        ("unregisterPublisher", [topic, api]) => {
            graph
                .publishers
                .entry(topic.to_string())
                .or_default()
                .retain(|known| known != api);
            update(&graph, topic);
            Ok(XmlRpcValue::Int(1))
        }
        ("registerService", [name, uri, _]) => {
            graph.services.insert(name.to_string(), uri.to_string());
            Ok(XmlRpcValue::Int(1))
        }
        ("unregisterService", [name, _]) => Ok(XmlRpcValue::Int(
            graph.services.remove(*name).is_some().into(),
        )),
        ("lookupService", [name]) => graph
            .services
            .get(*name)
            .cloned()
            .map(XmlRpcValue::String)
            .ok_or("no".to_string()),
        ("setParam", [name, _]) => {
            graph
                .parameters
                .insert(name.to_string(), arguments[2].clone());
            Ok(XmlRpcValue::Int(0))
        }
        ("getParam", [name]) => graph.parameters.get(*name).cloned().ok_or("no".to_string()),
        ("getPid" | "unregisterSubscriber", _) => Ok(XmlRpcValue::Int(1)),
        _ => refuse(),
    };
    let (status, explanation, value) = match result {
        Ok(value) => (1, String::new(), value),
        Err(reason) => (-1, reason, XmlRpcValue::Int(0)),
    };
    response_text(&XmlRpcValue::Array(vec![
        XmlRpcValue::Int(status),
        XmlRpcValue::String(explanation),
        value,
    ]))
}

/// Tells subscribers, on a thread of its own, as the master does.
fn update(graph: &Graph, topic: &str) {
    let publishers = graph
        .publishers
        .get(topic)
        .cloned()
        .unwrap_or_default()
        .into_iter()
        .map(XmlRpcValue::String)
        .collect();
    let arguments = [
        XmlRpcValue::text("/master"),
        XmlRpcValue::text(topic),
        XmlRpcValue::Array(publishers),
    ];
    for api in graph.subscribers.get(topic).cloned().unwrap_or_default() {
        let text = call_text("publisherUpdate", &arguments);
        std::thread::spawn(move || {
            let place = Place::parse(&api, "http").expect("an address");
            drop(http::post(
                NodeNetwork::Loopback,
                &place,
                &text,
                Duration::from_secs(5),
            ));
        });
    }
}

/// Asks again and again, for some seconds.
fn until<T>(mut ask: impl FnMut() -> Option<T>) -> T {
    let deadline = crate::clock::Deadline::after(Duration::from_secs(20));
    while deadline.left().is_some() {
        if let Some(answer) = ask() {
            return answer;
        }
        std::thread::yield_now();
    }
    panic!("not in time");
}

fn text_type() -> MessageType {
    MessageType {
        name: "std_msgs/String".into(),
        md5: "992ce8a1687cec8c8bd883ec73ca41d1".into(),
        definition: "string data\n".into(),
    }
}

fn service_type() -> ServiceType {
    ServiceType {
        name: "std_srvs/Trigger".into(),
        md5: "937c9679a518e3a18d831e57125ea522".into(),
    }
}

#[test]
fn messages_go_from_node_to_node_whoever_is_first() {
    let master = Master::start();
    let (a, b) = (master.node("a"), master.node("b"));
    let before = b
        .subscribe("chatter", &text_type(), 10)
        .expect("a subscriber");
    let publisher = a
        .publish("/chatter", &text_type(), 10, false)
        .expect("a publisher");
    let own = a
        .subscribe("/chatter", &text_type(), 10)
        .expect("a subscriber of its own topic");
    until(|| (publisher.subscribers() == 2).then_some(()));
    publisher.publish(b"hello".to_vec());
    assert_eq!(until(|| before.take()), b"hello");
    assert_eq!(until(|| own.take()), b"hello");
    drop((before, own));
    until(|| (publisher.subscribers() == 0).then_some(()));
    assert_eq!(master.publishers("/chatter"), 1);
    drop(publisher);
    assert_eq!(master.publishers("/chatter"), 0);
}

#[test]
fn latched_topics_tell_the_last_message_and_other_types_are_a_problem() {
    let master = Master::start();
    let node = master.node("a");
    let publisher = node
        .publish("/map", &text_type(), 1, true)
        .expect("a publisher");
    (0..3).for_each(|n| publisher.publish(vec![n]));
    let subscriber = node
        .subscribe("/map", &text_type(), 1)
        .expect("a subscriber");
    assert_eq!(until(|| subscriber.take()), [2]);
    let other = MessageType {
        md5: "0".repeat(32),
        ..text_type()
    };
    assert!(matches!(
        node.publish("/map", &other, 1, true),
        Err(Error::Peer(_))
    ));
    let wrong = node.subscribe("/map", &other, 1).expect("a subscriber");
    let problem = until(|| wrong.problem());
    assert!(
        problem.contains("topic /map has type std_msgs/String"),
        "{problem}"
    );
}

#[test]
fn a_publisher_waits_for_nobody_and_a_slow_subscriber_reads_the_newest() {
    let master = Master::start();
    let node = master.node("a");
    let publisher = node
        .publish("/flood", &text_type(), 5, false)
        .expect("a publisher");
    let subscriber = node
        .subscribe("/flood", &text_type(), 3)
        .expect("a subscriber");
    until(|| (publisher.subscribers() == 1).then_some(()));
    for n in 0..200_u8 {
        publisher.publish(vec![n; 1 << 18]);
    }
    until(|| subscriber.take().filter(|message| message[0] == 199));
    assert!(subscriber.waiting() <= 3);
}

#[test]
fn services_answer_fail_and_end() {
    let master = Master::start();
    let (a, b) = (master.node("a"), master.node("b"));
    let server = a.offer("/do", &service_type()).expect("a service");
    assert!(a.offer("/do", &service_type()).is_err());
    let ask = |request: &[u8]| {
        b.call("/do", &service_type(), request.to_vec())
            .expect("a call")
    };
    let call = ask(b"abc");
    let request = until(|| server.take());
    assert_eq!(request.bytes, b"abc");
    request.answer(Ok(b"def".to_vec()));
    assert_eq!(until(|| call.poll()).expect("an answer"), b"def");
    let call = ask(b"");
    until(|| server.take()).answer(Err("not today".into()));
    assert_eq!(
        until(|| call.poll()).expect_err("no answer").to_string(),
        "not today"
    );
    let call = ask(b"");
    until(|| server.take()).answer(Err(String::new()));
    drop(call);
    let call = ask(b"");
    let waiting = until(|| server.take());
    drop((waiting, server));
    assert_eq!(
        until(|| call.poll()).expect_err("no answer").to_string(),
        "the service has ended"
    );
    assert!(until(|| ask(b"").poll()).is_err());
    let other = ServiceType {
        md5: "0".repeat(32),
        ..service_type()
    };
    let _again = a.offer("/do", &service_type()).expect("a service");
    let call = b.call("/do", &other, Vec::new()).expect("a call");
    assert!(
        until(|| call.poll())
            .expect_err("another type")
            .to_string()
            .contains("has type std_srvs/Trigger")
    );
}

#[test]
fn parameters_and_masters_that_are_not_there() {
    let master = Master::start();
    let node = master.node("a");
    let value = XmlRpcValue::Struct(vec![("x".into(), XmlRpcValue::Double(0.5))]);
    node.set_parameter("~gain", value.clone())
        .expect("a parameter");
    assert_eq!(node.parameter("/a/gain").expect("an answer"), Some(value));
    assert_eq!(node.parameter("/none").expect("an answer"), None);
    let nobody = NodeSettings {
        master: "http://127.0.0.1:1".into(),
        network: NodeNetwork::Loopback,
        namespace: String::new(),
        name: "a".into(),
    };
    assert!(matches!(Node::new(&nobody), Err(Error::Master { .. })));
    let elsewhere = NodeSettings {
        master: "http://192.0.2.1:11311".into(),
        ..nobody
    };
    let error = Node::new(&elsewhere).err().expect("no node").to_string();
    assert!(error.contains("outside of this machine"), "{error}");
}
