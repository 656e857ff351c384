//! What the master and other nodes ask a node.

use crate::XmlRpcValue;
use crate::node::Shared;
use crate::xmlrpc::{fault_text, read_call, response_text};

/// The answer to a call, as text.
pub(crate) fn answer(node: &Shared, body: &[u8]) -> String {
    match read_call(body) {
        Err(error) => fault_text(1, &error.to_string()),
        Ok((method, arguments)) => match perform(node, &method, &arguments) {
            None => fault_text(
                2,
                &format!("there is no method {method} with these arguments"),
            ),
            Some(Ok(value)) => response_text(&status(1, "", value)),
            Some(Err(reason)) => response_text(&status(0, &reason, XmlRpcValue::Int(0))),
        },
    }
}

fn status(status: i32, explanation: &str, value: XmlRpcValue) -> XmlRpcValue {
    XmlRpcValue::Array(vec![
        XmlRpcValue::Int(status),
        XmlRpcValue::text(explanation),
        value,
    ])
}

/// None for what is not understood.
fn perform(
    node: &Shared,
    method: &str,
    arguments: &[XmlRpcValue],
) -> Option<Result<XmlRpcValue, String>> {
    let topics = |topics: Vec<(String, String)>| {
        let pair = |(name, kind): (String, String)| {
            XmlRpcValue::Array(vec![XmlRpcValue::String(name), XmlRpcValue::String(kind)])
        };
        XmlRpcValue::Array(topics.into_iter().map(pair).collect())
    };
    let nothing = || XmlRpcValue::Array(Vec::new());
    Some(Ok(match (method, arguments) {
        ("getPid", _) => XmlRpcValue::Int(i32::try_from(std::process::id()).unwrap_or_default()),
        ("getMasterUri", _) => XmlRpcValue::text(&node.master.uri),
        ("getPublications", _) => topics(node.publications()),
        ("getSubscriptions", _) => topics(node.subscriptions()),
        ("getBusInfo", _) => XmlRpcValue::Array(bus_info(node)),
        ("getBusStats", _) => XmlRpcValue::Array(vec![nothing(), nothing(), nothing()]),
        ("paramUpdate", [_, _, _]) => XmlRpcValue::Int(0),
        (
            "publisherUpdate",
            [
                _,
                XmlRpcValue::String(topic),
                XmlRpcValue::Array(publishers),
            ],
        ) => {
            let publishers = publishers
                .iter()
                .filter_map(|uri| uri.as_text().map(String::from));
            node.update_publishers(topic, &publishers.collect::<Vec<_>>());
            XmlRpcValue::Int(0)
        }
        ("requestTopic", [_, XmlRpcValue::String(topic), XmlRpcValue::Array(protocols)]) => {
            return Some(request_topic(node, topic, protocols));
        }
        ("shutdown", _) => {
            return Some(Err(
                "a simulator does not end on request of other nodes".into()
            ));
        }
        _ => return None,
    }))
}

fn request_topic(
    node: &Shared,
    topic: &str,
    protocols: &[XmlRpcValue],
) -> Result<XmlRpcValue, String> {
    let is_tcpros = |protocol: &XmlRpcValue| match protocol.as_array() {
        Some([name, ..]) => name.as_text() == Some("TCPROS"),
        _ => false,
    };
    if node.topic(topic).is_none() {
        return Err(format!("{topic} is not published here"));
    }
    if !protocols.iter().any(is_tcpros) {
        return Err("only TCPROS is supported".into());
    }
    let (host, port) = node.tcpros_place();
    Ok(XmlRpcValue::Array(vec![
        XmlRpcValue::text("TCPROS"),
        XmlRpcValue::text(host),
        XmlRpcValue::Int(port.into()),
    ]))
}

/// The connections: number, the other side, direction, protocol, topic, whether it is connected.
fn bus_info(node: &Shared) -> Vec<XmlRpcValue> {
    let connections = node.connections();
    let entry = |(number, (other, direction, topic)): (usize, (String, &str, String))| {
        XmlRpcValue::Array(vec![
            XmlRpcValue::Int(i32::try_from(number).unwrap_or(i32::MAX)),
            XmlRpcValue::String(other),
            XmlRpcValue::text(direction),
            XmlRpcValue::text("TCPROS"),
            XmlRpcValue::String(topic),
            XmlRpcValue::Bool(true),
        ])
    };
    connections.into_iter().enumerate().map(entry).collect()
}
