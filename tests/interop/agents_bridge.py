"""Calls tools of `swanilda mcp` by the official client: a line of JSON with `tool` and `arguments` in, one with what was answered out."""

import asyncio
import json
import sys

from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client


async def main(command, *arguments):
    server = StdioServerParameters(command=command, args=['mcp', *arguments])
    async with stdio_client(server) as streams, ClientSession(streams[0], streams[1]) as session:
        await session.initialize()
        while line := await asyncio.to_thread(sys.stdin.readline):
            call = json.loads(line)
            result = await session.call_tool(call['tool'], call['arguments'])
            answer = {
                'text': '\n'.join(part.text for part in result.content if part.type == 'text'),
                'values': result.structured_content,
                'pictures': sum(part.type == 'image' for part in result.content),
                'isError': bool(result.is_error),
            }
            print(json.dumps(answer), flush=True)


asyncio.run(main(*sys.argv[1:]))
