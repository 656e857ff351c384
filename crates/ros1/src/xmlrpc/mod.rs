//! XML-RPC: values, calls and answers as texts.

mod read;
mod write;

pub(crate) use read::{read_call, read_response};
pub(crate) use write::{call_text, fault_text, response_text};

/// A value of XML-RPC, such as that of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum XmlRpcValue {
    /// `boolean`.
    Bool(bool),
    /// `int` and `i4`.
    Int(i32),
    /// `double`.
    Double(f64),
    /// `string`, and values without a type.
    String(String),
    /// `base64`.
    Binary(Vec<u8>),
    /// `array`.
    Array(Vec<XmlRpcValue>),
    /// `struct`.
    Struct(Vec<(String, XmlRpcValue)>),
}

impl XmlRpcValue {
    pub(crate) fn text(text: &str) -> Self {
        Self::String(text.to_string())
    }

    pub(crate) fn as_text(&self) -> Option<&str> {
        match self {
            Self::String(text) => Some(text),
            _ => None,
        }
    }

    pub(crate) fn as_array(&self) -> Option<&[Self]> {
        match self {
            Self::Array(items) => Some(items),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_as_they_are_written() {
        let values = [
            XmlRpcValue::Bool(true),
            XmlRpcValue::Int(-5),
            XmlRpcValue::Double(0.1),
            XmlRpcValue::Double(1e300),
            XmlRpcValue::text("a <b> & \"c\" é\n"),
            XmlRpcValue::text(""),
            XmlRpcValue::Binary(vec![0, 255, 7]),
            XmlRpcValue::Array(vec![XmlRpcValue::Array(vec![]), XmlRpcValue::Int(1)]),
            XmlRpcValue::Struct(vec![
                ("a".into(), XmlRpcValue::Int(1)),
                ("b<".into(), XmlRpcValue::text("x")),
            ]),
        ];
        let (method, read) = read_call(call_text("setParam", &values).as_bytes()).expect("a call");
        assert_eq!(
            (method.as_str(), read.as_slice()),
            ("setParam", &values[..])
        );
        for value in values {
            assert_eq!(
                read_response(response_text(&value).as_bytes()).expect("a response"),
                value
            );
        }
    }

    #[test]
    fn texts_of_others_are_understood() {
        let text = "<?xml version='1.0'?>\n<methodResponse>\n<params>\n<param>\n<value><array><data>\n<value><i4>1</i4></value>\n\
            <value>plain</value><value/><value><boolean>0</boolean></value><value><string> x </string></value><value><nil/></value>\
            </data></array></value></param></params></methodResponse>";
        let text_value = XmlRpcValue::text;
        let expected = vec![
            XmlRpcValue::Int(1),
            text_value("plain"),
            text_value(""),
            XmlRpcValue::Bool(false),
            text_value(" x "),
            text_value(""),
        ];
        assert_eq!(
            read_response(text.as_bytes()).expect("a response"),
            XmlRpcValue::Array(expected)
        );
        let fault = read_response(fault_text(3, "no < such").as_bytes()).expect_err("a fault");
        assert_eq!(fault.to_string(), "no < such");
    }

    #[test]
    fn hostile_texts_are_refused() {
        let deep = format!(
            "<methodResponse><params><param>{}</param></params></methodResponse>",
            "<value><array><data>".repeat(500)
        );
        let entity = "<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'>]><methodResponse><params><param><value>&a;</value></param></params></methodResponse>";
        let closed = "<value><array><data>".repeat(60) + &"</data></array></value>".repeat(60);
        let closed =
            format!("<methodResponse><params><param>{closed}</param></params></methodResponse>");
        for text in [
            "",
            "x",
            "<a/>",
            "<methodResponse/>",
            "<methodCall/>",
            &deep,
            entity,
            &closed,
        ] {
            assert!(read_response(text.as_bytes()).is_err(), "{text}");
            assert!(read_call(text.as_bytes()).is_err(), "{text}");
        }
        assert!(read_response(b"\xff\xfe").is_err());
    }
}
