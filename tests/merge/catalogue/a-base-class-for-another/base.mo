model A
  extends B;
end A;
