//! XML as calls, answers and values.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use bounded_xml::{Document, DocumentType, Node};

use super::XmlRpcValue;
use crate::{Error, Result, limits};

/// The most elements and texts that a document has.
const NODES: u32 = 1 << 20;

/// A call: the method and its arguments.
pub(crate) fn read_call(bytes: &[u8]) -> Result<(String, Vec<XmlRpcValue>)> {
    let text = text_of(bytes)?;
    let document = parse(text)?;
    let root = document.root_element();
    if !root.has_tag_name("methodCall") {
        return Err(Error::protocol("no methodCall"));
    }
    let method = child(root, "methodName")
        .and_then(|node| node.text())
        .unwrap_or_default()
        .trim()
        .to_string();
    if method.is_empty() {
        return Err(Error::protocol("no methodName"));
    }
    Ok((method, values_of_params(root)?))
}

/// The value of an answer.
///
/// # Errors
/// If it is none, or says that the call failed.
pub(crate) fn read_response(bytes: &[u8]) -> Result<XmlRpcValue> {
    let text = text_of(bytes)?;
    let document = parse(text)?;
    let root = document.root_element();
    if let Some(value) = child(root, "fault").and_then(|fault| child(fault, "value")) {
        return Err(Error::Peer(fault_reason(read_value(value, 0)?)));
    }
    let values = if root.has_tag_name("methodResponse") {
        values_of_params(root)?
    } else {
        Vec::new()
    };
    values
        .into_iter()
        .next()
        .ok_or_else(|| Error::protocol("an answer without a value"))
}

fn fault_reason(fault: XmlRpcValue) -> String {
    let XmlRpcValue::Struct(members) = fault else {
        return "a fault".into();
    };
    let reason = members.into_iter().find(|(name, _)| name == "faultString");
    reason
        .and_then(|(_, value)| value.as_text().map(String::from))
        .unwrap_or_else(|| "a fault".into())
}

fn text_of(bytes: &[u8]) -> Result<&str> {
    std::str::from_utf8(bytes).map_err(|_| Error::protocol("XML that is not UTF-8"))
}

fn parse(text: &str) -> Result<Document<'_>> {
    bounded_xml::parse(text, NODES, DocumentType::Refused)
        .map_err(|error| Error::protocol(format!("XML: {error}")))
}

fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.has_tag_name(tag))
}

fn values_of_params(root: Node) -> Result<Vec<XmlRpcValue>> {
    let Some(params) = child(root, "params") else {
        return Ok(Vec::new());
    };
    let values = params
        .children()
        .filter(|node| node.has_tag_name("param"))
        .map(|param| {
            let value =
                child(param, "value").ok_or_else(|| Error::protocol("a param without a value"))?;
            read_value(value, 0)
        });
    values.collect()
}

fn read_value(value: Node, depth: usize) -> Result<XmlRpcValue> {
    if depth == limits::NESTING {
        return Err(Error::protocol("values that are nested too deeply"));
    }
    let Some(typed) = value.children().find(Node::is_element) else {
        return Ok(XmlRpcValue::String(content(value)));
    };
    let text = content(typed);
    let number = || text.trim().to_string();
    let wrong = || Error::protocol(format!("'{text}' is no {}", typed.tag_name().name()));
    match typed.tag_name().name() {
        "string" => Ok(XmlRpcValue::String(text)),
        "int" | "i4" => number().parse().map(XmlRpcValue::Int).map_err(|_| wrong()),
        "boolean" => match number().as_str() {
            "0" => Ok(XmlRpcValue::Bool(false)),
            "1" => Ok(XmlRpcValue::Bool(true)),
            _ => Err(wrong()),
        },
        "double" => number()
            .parse()
            .map(XmlRpcValue::Double)
            .map_err(|_| wrong()),
        "base64" => {
            let digits: String = text.split_whitespace().collect();
            BASE64_STANDARD
                .decode(digits)
                .map(XmlRpcValue::Binary)
                .map_err(|_| wrong())
        }
        "array" => {
            let data =
                child(typed, "data").ok_or_else(|| Error::protocol("an array without data"))?;
            let items = data.children().filter(|node| node.has_tag_name("value"));
            items
                .map(|item| read_value(item, depth + 1))
                .collect::<Result<_>>()
                .map(XmlRpcValue::Array)
        }
        "struct" => {
            let members = typed.children().filter(|node| node.has_tag_name("member"));
            members
                .map(|member| read_member(member, depth))
                .collect::<Result<_>>()
                .map(XmlRpcValue::Struct)
        }
        // Python's None, which the master returns for nothing.
        "nil" => Ok(XmlRpcValue::text("")),
        // A date is a text for programs that do not know dates.
        "dateTime.iso8601" => Ok(XmlRpcValue::String(text)),
        other => Err(Error::protocol(format!("values of type {other}"))),
    }
}

fn read_member(member: Node, depth: usize) -> Result<(String, XmlRpcValue)> {
    let name = child(member, "name")
        .map(content)
        .ok_or_else(|| Error::protocol("a member without a name"))?;
    let value =
        child(member, "value").ok_or_else(|| Error::protocol("a member without a value"))?;
    Ok((name, read_value(value, depth + 1)?))
}

/// All text below a node; comments divide it.
fn content(node: Node) -> String {
    node.children()
        .filter(Node::is_text)
        .filter_map(|text| text.text())
        .collect()
}
