"""Bytes that only this user has: by them this program knows again what it wrote itself.

They lie in the cache folder, which is private to the user, and stay when its entries go.
"""

from __future__ import annotations

import hashlib
import os

from adamslite.caching.entries import recall

NAME, SIZE = "secret", 32
#: Bytes of a seal.
SEAL = 16
#: The secret that this process has sealed with: where the cache goes under it, it is put back.
_held: list[bytes] = []


def seal(content: bytes) -> bytes:
    """What nobody else can say of a content: its BLAKE2b with the secret as key."""
    return hashlib.blake2b(content, digest_size=SEAL, key=_secret()).digest()


def _secret() -> bytes:
    _held[:] = [recall(NAME, lambda: _held[0] if _held else os.urandom(SIZE))]
    return _held[0]
