"""The official client of the Model Context Protocol against `swanilda mcp`: by standard input and output, or by HTTP (URL and SECRET)."""

import asyncio
import base64
import sys

import httpx2
from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client
from mcp.client.streamable_http import streamable_http_client


def text(result):
    return '\n'.join(part.text for part in result.content if part.type == 'text')


async def use(streams):
    async with ClientSession(streams[0], streams[1]) as session:
        hello = await session.initialize()
        assert hello.server_info.name == 'swanilda', hello
        names = {tool.name for tool in (await session.list_tools()).tools}
        assert {'scene', 'run_until', 'picture', 'compare_variants'} <= names, names

        made = await session.call_tool('run_code', {'code': "sim.setObjectAlias(sim.createDummy(0.1), 'Mark') return 6 * 7"})
        assert not made.is_error and text(made) == '42', made
        scene = text(await session.call_tool('scene', {}))
        assert 'Mark' in scene, scene
        stepped = await session.call_tool('step', {'count': 3, 'watch': ['/Mark.position']})
        assert stepped.structured_content['steps'] == 3, stepped
        assert len(stepped.structured_content['samples']['columns']) == 4, stepped
        wrong = await session.call_tool('get_properties', {'items': ['/Mrak.position']})
        assert wrong.is_error and '/Mark' in text(wrong), wrong

        await progress(session)
        picture = await session.call_tool('picture', {'width': 64, 'height': 48})
        images = [part for part in picture.content if part.type == 'image']
        assert len(images) == 1 and base64.b64decode(images[0].data).startswith(b'\x89PNG'), picture

        uris = [str(resource.uri) for resource in (await session.list_resources()).resources]
        assert 'scene://tree' in uris, uris
        assert (await session.list_resource_templates()).resource_templates
        read = await session.read_resource('scene://tree')
        assert 'Mark' in read.contents[0].text, read
        page = await session.read_resource('docs://PROPERTIES.md')
        assert page.contents[0].text.startswith('# Properties'), page


async def progress(session):
    """A run of a second by the wall clock says meanwhile how far it is, by simulated time."""
    notes = []

    async def note(done, total, message):
        notes.append((done, total, message))

    await session.call_tool('run_code', {'code': 'begin = sim.getSystemTime()'})
    until = {'until': {'lua': 'sim.getSystemTime() > begin + 1'}, 'time': 1e6}
    result = await session.call_tool('run_until', until, progress_callback=note)
    assert result.structured_content['reached'], result
    times = [done for done, _, _ in notes]
    assert notes and times == sorted(set(times)) and times[-1] <= result.structured_content['time'], (notes, result)
    assert all(total == 1e6 and 'simulated time' in message for _, total, message in notes), notes


async def by_stdio(command):
    async with stdio_client(StdioServerParameters(command=command, args=['mcp'])) as streams:
        await use(streams)


async def by_http(url, secret):
    async with httpx2.AsyncClient(headers={'Authorization': f'Bearer {secret}'}, timeout=60) as client:
        async with streamable_http_client(url, http_client=client) as streams:
            await use(streams)
        async with streamable_http_client(url, http_client=client) as streams:
            async with ClientSession(streams[0], streams[1]) as second:
                await second.initialize()
                # All sessions share the simulator.
                assert 'Mark' in text(await second.call_tool('scene', {}))
    await refusals(url, secret)


async def refusals(url, secret):
    hello = {'jsonrpc': '2.0', 'id': 1, 'method': 'initialize', 'params': {'protocolVersion': '2025-06-18'}}
    right = {'Authorization': f'Bearer {secret}'}
    async with httpx2.AsyncClient() as client:
        for headers, status in [
            ({}, 401),
            ({'Authorization': 'Bearer 0123456789abcdef0'}, 401),
            (right | {'Origin': 'https://example.com'}, 403),
            (right | {'Host': 'example.com'}, 403),
            (right | {'Accept': 'text/html'}, 406),
            (right | {'Mcp-Session-Id': 'nobody'}, 404),
            (right | {'MCP-Protocol-Version': '1999-01-01'}, 400),
            (right | {'Origin': 'http://localhost:1234'}, 200),
        ]:
            reply = await client.post(url, json=hello, headers=headers)
            assert reply.status_code == status, (headers, reply.status_code, reply.text)
        assert (await client.get(url, headers=right)).status_code == 405
        assert (await client.post(url, content=b'{', headers=right)).status_code == 400
        ping = {'jsonrpc': '2.0', 'id': 2, 'method': 'tools/list'}
        assert (await client.post(url, json=ping, headers=right)).status_code == 400
        session = right | {'Mcp-Session-Id': reply.headers['mcp-session-id']}
        assert (await client.post(url, json=ping, headers=session)).status_code == 200
        note = {'jsonrpc': '2.0', 'method': 'notifications/initialized'}
        assert (await client.post(url, json=note, headers=session)).status_code == 202
        assert (await client.delete(url, headers=session)).status_code == 204
        assert (await client.post(url, json=ping, headers=session)).status_code == 404


asyncio.run(by_http(*sys.argv[2:]) if sys.argv[1] == 'http' else by_stdio(sys.argv[2]))
