//! Values, calls and answers as XML.

use std::fmt::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::XmlRpcValue;

/// A call of a method.
pub(crate) fn call_text(method: &str, arguments: &[XmlRpcValue]) -> String {
    let mut text =
        format!("<?xml version=\"1.0\"?>\n<methodCall><methodName>{method}</methodName><params>");
    for argument in arguments {
        text.push_str("<param>");
        write_value(argument, &mut text);
        text.push_str("</param>");
    }
    text + "</params></methodCall>\n"
}

/// The answer to a call.
pub(crate) fn response_text(value: &XmlRpcValue) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n<methodResponse><params><param>");
    write_value(value, &mut text);
    text + "</param></params></methodResponse>\n"
}

/// The answer to a call that is none.
pub(crate) fn fault_text(code: i32, reason: &str) -> String {
    let members = vec![
        ("faultCode".into(), XmlRpcValue::Int(code)),
        ("faultString".into(), XmlRpcValue::String(reason.into())),
    ];
    let mut text = String::from("<?xml version=\"1.0\"?>\n<methodResponse><fault>");
    write_value(&XmlRpcValue::Struct(members), &mut text);
    text + "</fault></methodResponse>\n"
}

fn write_value(value: &XmlRpcValue, text: &mut String) {
    text.push_str("<value>");
    match value {
        XmlRpcValue::Bool(value) => tagged("boolean", if *value { "1" } else { "0" }, text),
        XmlRpcValue::Int(value) => tagged("int", &value.to_string(), text),
        XmlRpcValue::Double(value) => tagged("double", &value.to_string(), text),
        XmlRpcValue::String(value) => tagged("string", &escaped(value), text),
        XmlRpcValue::Binary(value) => tagged("base64", &BASE64_STANDARD.encode(value), text),
        XmlRpcValue::Array(items) => {
            text.push_str("<array><data>");
            items.iter().for_each(|item| write_value(item, text));
            text.push_str("</data></array>");
        }
        XmlRpcValue::Struct(members) => {
            text.push_str("<struct>");
            for (name, value) in members {
                write!(text, "<member><name>{}</name>", escaped(name))
                    .expect("a string takes everything");
                write_value(value, text);
                text.push_str("</member>");
            }
            text.push_str("</struct>");
        }
    }
    text.push_str("</value>");
}

fn tagged(tag: &str, content: &str, text: &mut String) {
    write!(text, "<{tag}>{content}</{tag}>").expect("a string takes everything");
}

/// Characters that XML does not have become question marks.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '\r' => out.push_str("&#13;"),
            '\n' | '\t' => out.push(c),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('?'),
            _ => out.push(c),
        }
    }
    out
}
